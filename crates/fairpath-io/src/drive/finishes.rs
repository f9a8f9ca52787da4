//! How the surfaces of scenes look: colours in light, not in screen values.

use fairpath_drive::{Finish, Material};

/// The look of a finish.
pub(super) struct Look {
    pub(super) name: &'static str,
    pub(super) colour: [f64; 3],
    pub(super) roughness: f64,
    pub(super) metallic: f64,
}

/// The look of a finish.
pub(super) fn look(finish: Finish) -> Look {
    let (name, colour, roughness, metallic) = match finish {
        Finish::Section(Material::Asphalt) => ("asphalt", [0.045, 0.046, 0.05], 0.9, 0.0),
        Finish::Section(Material::Concrete) => ("concrete", [0.45, 0.44, 0.41], 0.85, 0.0),
        Finish::Section(Material::Ballast) => ("ballast", [0.2, 0.18, 0.16], 1.0, 0.0),
        Finish::Section(Material::Earth) => ("trodden earth", [0.3, 0.22, 0.13], 1.0, 0.0),
        Finish::Section(Material::Grass) => ("grass", [0.09, 0.2, 0.05], 1.0, 0.0),
        Finish::Section(Material::Steel) => ("steel", [0.55, 0.56, 0.58], 0.4, 0.8),
        Finish::Section(Material::Wood) => ("wood", [0.13, 0.08, 0.05], 0.9, 0.0),
        Finish::Section(Material::Paint) => ("paint", [0.85, 0.85, 0.82], 0.6, 0.0),
        Finish::Section(Material::Cloth) => ("cloth", [0.6, 0.05, 0.12], 0.8, 0.0),
        Finish::Ground => ("ground", [0.16, 0.24, 0.09], 1.0, 0.0),
        Finish::Earthwork => ("earthwork", [0.3, 0.24, 0.15], 1.0, 0.0),
        Finish::Water => ("water", [0.03, 0.12, 0.2], 0.1, 0.0),
        Finish::Leaves => ("leaves", [0.06, 0.2, 0.03], 1.0, 0.0),
        Finish::Needles => ("needles", [0.02, 0.1, 0.04], 1.0, 0.0),
        Finish::Bark => ("bark", [0.12, 0.08, 0.05], 1.0, 0.0),
        Finish::SignRed => ("sign red", [0.6, 0.01, 0.01], 0.5, 0.0),
        Finish::SignYellow => ("sign yellow", [0.9, 0.5, 0.0], 0.5, 0.0),
        Finish::SignWhite => ("sign white", [0.9, 0.9, 0.9], 0.5, 0.0),
        Finish::SignBlack => ("sign black", [0.01, 0.01, 0.01], 0.5, 0.0),
        Finish::Light => ("lamp", [1.0, 0.9, 0.6], 0.5, 0.0),
    };
    Look { name, colour, roughness, metallic }
}
