//! How long edges will be, told without remeshing.

use super::{Allowance, Curves, DETAIL, Patches};
use crate::input::{Rules, Surface};

/// How long edges will be where a surface is remeshed for lengths that are asked for.
pub struct Wanted {
    /// Of each vertex, the length of edges there: as asked for, or what the shape needs if that is less, model units.
    pub at: Vec<f64>,
    /// Feature edges, lower vertex first, each with its curve.
    pub features: Vec<([u32; 2], u32)>,
    /// The curves between corners, but for those that are so short beside edges that they will be gone.
    pub curves: Vec<Option<Curve>>,
}

/// A curve of feature edges.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    /// Its length, model units.
    pub length: f64,
    /// The corners where it ends; none if it is closed.
    pub ends: Vec<u32>,
}

impl Wanted {
    /// Measures a surface, as remeshing does before it begins. n log n.
    pub fn new(surface: &Surface, rules: &Rules<'_>) -> Self {
        let patches = Patches::new(surface, rules);
        let curves = Curves::new(surface, rules, &patches);
        let allowance = Allowance::new(surface, rules, &patches, &curves);
        let mut all = vec![Curve::default(); curves.count];
        for (ends, &number) in curves.ends.iter().zip(&curves.of) {
            let curve = &mut all[number as usize];
            let [a, b] = ends.map(|v| surface.points[v as usize]);
            curve.length += a.distance(b);
            let corners = ends.iter().filter(|&&v| curves.corner[v as usize]);
            curve.ends.extend(corners);
        }
        let size = allowance.size;
        let is_detail = |curve: &Curve| {
            let ends = curve.ends.iter().map(|&v| size[v as usize]);
            curve.length < DETAIL * ends.fold(f64::INFINITY, f64::min)
        };
        let there = all.into_iter();
        let there = there
            .map(|curve| Some(curve).filter(|curve| curve.ends.is_empty() || !is_detail(curve)));
        Self {
            curves: there.collect(),
            at: size,
            features: curves.ends.into_iter().zip(curves.of).collect(),
        }
    }
}
