//! Shaders for browsers, where no test here draws: judged by the translator that would translate them there.

use naga::back::glsl;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{ShaderStage, proc};

const SURFACE: &str = include_str!("../../src/shaders/surface.wgsl");

/// The text in the language of WebGL 2, without any of what WebGL 2 lacks.
fn for_webgl_2(source: &str, stage: ShaderStage, entry_point: &str) -> Result<String, String> {
    let module = naga::front::wgsl::parse_str(source).map_err(|e| e.emit_to_string(source))?;
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
    let info = validator.validate(&module).map_err(|e| e.emit_to_string(source))?;
    let options =
        glsl::Options { version: glsl::Version::Embedded { version: 300, is_webgl: true }, ..glsl::Options::default() };
    let pipeline = glsl::PipelineOptions { shader_stage: stage, entry_point: entry_point.into(), multiview: None };
    let mut text = String::new();
    glsl::Writer::new(&mut text, &module, &info, &options, &pipeline, proc::BoundsCheckPolicies::default())
        .and_then(|mut writer| writer.write())
        .map_err(|e| e.to_string())?;
    Ok(text)
}

#[test]
fn the_shader_of_surfaces_needs_no_more_than_webgl_2_has() {
    for (stage, entry_point) in [(ShaderStage::Vertex, "place_corner"), (ShaderStage::Fragment, "shade")] {
        let text = for_webgl_2(SURFACE, stage, entry_point).unwrap_or_else(|problem| panic!("{problem}"));
        assert!(text.starts_with("#version 300 es"), "{text}");
    }
}

#[test]
fn the_judge_finds_fault_with_what_webgl_2_lacks() {
    let storage = "@group(0) @binding(0) var<storage, read> numbers: array<f32>;
        @fragment fn shade() -> @location(0) vec4<f32> { return vec4(numbers[0]); }";
    assert!(for_webgl_2(storage, ShaderStage::Fragment, "shade").is_err());
}
