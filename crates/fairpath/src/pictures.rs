//! Results as files of every form, by way of fairpath-io.

use anyhow::Result;
use fairpath_curve::Spline;
use fairpath_fit::{CurvatureStages, Stages, Stroke, TemplateSet, Warning};
use fairpath_io::picture::{
    Comb, Correction, Layout, Picture, PictureOptions, StagePicture, draw_corrections, draw_curvature_stages,
    draw_pieces, draw_splines, draw_stages, draw_templates,
};
use fairpath_io::{Encoded, SplineFile, SplineFormat, StrokeFile, WriteOptions, YAxis, encode_splines};

use crate::args::OutputFormat;

/// A spline file in a format, with what that does not hold. A PNG shows the strokes, if given, behind their curves.
///
/// # Errors
/// When something cannot be expressed in the format.
pub(crate) fn encode(
    file: &SplineFile,
    strokes: Option<&StrokeFile>,
    format: OutputFormat,
    flip_y: bool,
) -> Result<(Vec<u8>, Vec<Warning>)> {
    let mut options = WriteOptions::default();
    options.dxf.flip_y = flip_y;
    let Encoded { bytes, warnings } = encode_splines(file, spline_format(format), strokes, &options)?;
    Ok((bytes, warnings))
}

fn spline_format(format: OutputFormat) -> SplineFormat {
    match format {
        OutputFormat::Json => SplineFormat::Json,
        OutputFormat::Svg => SplineFormat::Svg,
        OutputFormat::Dxf => SplineFormat::Dxf,
        OutputFormat::Csv => SplineFormat::Csv,
        OutputFormat::Png => SplineFormat::Png,
    }
}

/// A picture of strokes and curves with joins, corners and curvature combs, as SVG or PNG.
///
/// # Errors
/// When there is no room for the picture's pixels.
pub(crate) fn overview(file: &SplineFile, strokes: &StrokeFile, png: bool, sheet: bool) -> Result<Vec<u8>> {
    let mut options = PictureOptions::default();
    options.comb = Comb::Auto;
    if sheet {
        options.layout = Layout::Sheet { columns: None };
    }
    let picture = draw_splines(file, Some(strokes), &options);
    Ok(if png { picture.to_png()? } else { picture.to_svg().as_bytes().to_vec() })
}

/// A picture of strokes, the French curves laid over them, and the result, as SVG or PNG.
///
/// # Errors
/// When there is no room for the picture's pixels.
pub(crate) fn with_templates(
    file: &SplineFile,
    strokes: &StrokeFile,
    templates: &TemplateSet,
    png: bool,
) -> Result<Vec<u8>> {
    let picture = draw_pieces(file, Some(strokes), templates, &PictureOptions::default());
    Ok(if png { picture.to_png()? } else { picture.to_svg().as_bytes().to_vec() })
}

/// A picture of sets of French curves, with their joins and curvature if `comb` says so.
pub(crate) fn sets(sets: &[TemplateSet], comb: bool) -> Picture {
    let mut options = PictureOptions::default();
    options.joins = comb;
    options.comb = if comb { Comb::Auto } else { Comb::Off };
    draw_templates(sets, &options)
}

/// A picture with a row for each correction, as SVG or PNG.
///
/// # Errors
/// When there is no room for the picture's pixels.
pub(crate) fn corrections(rows: &[Correction<'_>], y: YAxis, png: bool) -> Result<Vec<u8>> {
    let mut options = PictureOptions::default();
    options.comb = Comb::Auto;
    let picture = draw_corrections(rows, y, &options);
    Ok(if png { picture.to_png()? } else { picture.to_svg().as_bytes().to_vec() })
}

/// The steps of a fit by shortest paths as pictures in the manner of the paper's figure 4: a word for each and its SVG.
pub(crate) fn steps(stroke: &Stroke, stages: &Stages, spline: &Spline, y: YAxis) -> Vec<(String, Vec<u8>)> {
    named(draw_stages(stroke, stages, spline, y, &PictureOptions::default()))
}

/// The steps of a fit in curvature space as pictures in the manner of that paper's figures 4 and 7: a word for each and its SVG.
pub(crate) fn curvature_steps(
    stroke: &Stroke,
    stages: &CurvatureStages,
    spline: &Spline,
    y: YAxis,
) -> Vec<(String, Vec<u8>)> {
    named(draw_curvature_stages(stroke, stages, spline, y, &PictureOptions::default()))
}

fn named(pictures: Vec<StagePicture>) -> Vec<(String, Vec<u8>)> {
    let name =
        |step: StagePicture| (format!("{}-{}", step.letter, step.name), step.picture.to_svg().as_bytes().to_vec());
    pictures.into_iter().map(name).collect()
}
