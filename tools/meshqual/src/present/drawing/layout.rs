//! The look of the pictures. All of it is a matter of taste: nothing is computed from it.

/// Sizes and directions of a picture.
pub struct Layout {
    /// Size, pixels.
    pub width: usize,
    /// Size, pixels.
    pub height: usize,
    /// Samples per pixel in each direction.
    pub samples: usize,
    /// Share of the picture that the mesh takes.
    pub fill: f64,
    /// Where the eye is: elevation above the ground and azimuth, degrees.
    pub eye: [f64; 2],
    /// Direction towards the light: right, down, towards the eye.
    pub light: [f64; 3],
    /// Brightness of faces away from the light.
    pub shade: f64,
    /// Brightness of edges as a share of their face's.
    pub edge_shade: f64,
    /// Half the width of edges, samples.
    pub edge: f64,
    /// Height of a triangle, samples, below which it is drawn without edges, which would fill it.
    pub smallest_with_edges: f64,
}

/// The layout of all pictures.
pub const LAYOUT: Layout = Layout {
    width: 720,
    height: 560,
    samples: 2,
    fill: 0.94,
    eye: [36.0, -62.0],
    light: [-0.35, -0.5, 0.8],
    shade: 0.55,
    edge_shade: 0.45,
    edge: 0.8,
    smallest_with_edges: 7.0,
};
