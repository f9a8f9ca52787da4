//! How a surface is to look: colours, the light it stands in, clay or zebra stripes.

/// A colour as screens take it: red, green and blue of sRGB.
pub type Colour = [u8; 3];

/// Everything about a picture that is neither the surface nor the camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Colour where there is no surface.
    pub background: Colour,
    /// Colour of the surface in white light.
    pub material: Colour,
    /// The room that it stands in.
    pub room: Room,
    /// What is shown of it.
    pub finish: Finish,
}

/// A room that lights a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Room {
    /// White walls: soft light from everywhere, for pages with a light background.
    Bright,
    /// A dark studio: deeper shadows, and light from behind that draws the edge against the dark.
    Dark,
}

/// What is shown of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Finish {
    /// Its shape, as if it were of clay with a little gloss.
    Clay,
    /// Its fairness, as a mirror of striped light.
    Zebra(Zebra),
}

/// Zebra stripes: what a mirror shows in a tunnel whose lamps are bent round it in hoops, dark and light by turns and very far away.
///
/// A stripe is where the reflected ray has one angle to the tunnel's axis, so it shows the first derivative of the surface: where tangent planes
/// break, stripes are torn; where curvature jumps, stripes have a kink; on a fair surface they flow, and their widths change evenly.
/// The tunnel stays with the viewer, so stripes run over the surface as it is turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Zebra {
    /// Number of pairs of a dark and a light stripe from one end of the tunnel to the other: 180 degrees of reflected rays.
    pub pairs: u16,
    /// Direction of the tunnel's axis on the picture, radians counterclockwise from upright. With 0 the hoops, and so the stripes, lie across.
    pub axis_rad: f64,
}

impl Default for Zebra {
    /// Eight pairs across: enough to cross a small feature, few enough to be told apart on a ball of 100 px.
    fn default() -> Self {
        Self { pairs: 8, axis_rad: 0.0 }
    }
}

/// Terracotta, as in the pictures of `fairpath inflate`.
const TERRACOTTA: Colour = [217, 130, 92];
const WHITE: Colour = [255, 255, 255];
/// Dark grey without a tint, lighter than black, so that shadows still lie on it.
const SLATE: Colour = [27, 27, 27];

impl Look {
    /// Terracotta in a bright room, on white.
    #[must_use]
    pub const fn light() -> Self {
        Self { background: WHITE, material: TERRACOTTA, room: Room::Bright, finish: Finish::Clay }
    }

    /// Terracotta in a dark room, on dark grey.
    #[must_use]
    pub const fn dark() -> Self {
        Self { background: SLATE, material: TERRACOTTA, room: Room::Dark, finish: Finish::Clay }
    }
}

/// Light in proportion, from a colour of sRGB (IEC 61966-2-1), each from 0 to 1.
pub(crate) fn linear(colour: Colour) -> [f32; 3] {
    colour.map(|byte| {
        let screen = f32::from(byte) / 255.0;
        if screen <= 0.040_45 { screen / 12.92 } else { ((screen + 0.055) / 1.055).powf(2.4) }
    })
}
