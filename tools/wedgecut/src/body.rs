//! The body to be cut, and what is known of it whatever is cut.

use crate::error::CutError;
use crate::graph::Graph;
use crate::params::{Params, Seam};
use estimate::{Asked, edge_of_volume};
use geom::edges::Edges;
use geom::measure::volume_of_region;
use geom::tolerance::{Extent, Tolerance};
use glam::DVec3;
use sizing::field::mean_volume;
use std::collections::BTreeMap;
use std::sync::Arc;
use tmesh::{Document, Frame, OUTSIDE, Size, Symmetry, Template, Triangle};

/// The body to be cut.
pub struct Body<'a> {
    /// The document it comes in.
    pub document: &'a Document,
    /// Its surface, in world coordinates.
    pub surface: &'a Template,
    /// Its symmetry.
    pub symmetry: &'a Symmetry,
    /// What is asked for.
    pub params: &'a Params,
    /// What counts as equal.
    pub tolerance: Tolerance,
    /// The frame with z along the axis and x along the symmetry's reference.
    pub frame: Frame,
    /// The seam asked for, where it is no plane, over heights of that frame.
    pub graph: Option<Arc<Graph>>,
    /// The largest volume of elements that would ask for as many of them as the size field does, if there is one, model units cubed.
    pub mean_volume: Option<f64>,
}

impl<'a> Body<'a> {
    /// Takes a document with one surface in world coordinates and a symmetry.
    ///
    /// # Errors
    /// A document that has been cut or meshed, without a symmetry or with one whose axis is none.
    pub fn new(document: &'a Document, params: &'a Params) -> Result<Self, CutError> {
        let symmetry = document.symmetry.as_ref().ok_or(CutError::NoSymmetry)?;
        if !document.is_plain() || !document.frame.is_identity() {
            return Err(CutError::NotASurface("this document has been cut already"));
        }
        let surface = &document.templates[0];
        if !surface.tets.is_empty() {
            return Err(CutError::NotASurface("this document holds a volume mesh"));
        }
        let [origin, axis] = [symmetry.axis.point, symmetry.axis.direction].map(DVec3::from);
        let frame = symmetry
            .frame()
            .filter(|f| f.rotation.is_finite() && f.origin.is_finite())
            .ok_or(CutError::BadAxis(axis.x, axis.y, axis.z))?;
        let extent = Extent::about(&surface.vertices, origin, axis);
        let precision = document.source.as_ref().map_or(0.0, |s| s.precision);
        let tolerance = Tolerance::new(extent, precision, symmetry.residual)
            .with_snap(params.snap)
            .with_detail(params.clean);
        // A table has heights along the axis from the origin of the input.
        let graph = match &params.seam {
            Seam::Graph(graph) => Some(Arc::new((**graph).clone().raised(-frame.origin.dot(axis)))),
            Seam::Plane | Seam::Auto => None,
        };
        let all: f64 = region_volumes(&surface.vertices, &surface.triangles)
            .values()
            .sum();
        Ok(Self {
            mean_volume: mean_volume((document, 0), all),
            graph,
            document,
            surface,
            symmetry,
            params,
            tolerance,
            frame,
        })
    }

    /// Largest volume of an element in a region that will be asked for, model units cubed.
    pub fn max_volume(&self, region: u32) -> Option<f64> {
        let regions = &self.document.regions;
        let at = regions.binary_search_by_key(&region, |r| r.id).ok()?;
        let size = regions[at].size.or(self.document.wishes.size);
        let volumes = size.map(Size::max_volume).into_iter();
        volumes.chain(self.mean_volume).reduce(f64::min)
    }

    /// The least elements that sizes asked for take: those of the largest volume in each region.
    pub fn least_by_sizes(&self) -> f64 {
        let of_region = |id| {
            let (vertices, faces) = (&self.surface.vertices, self.surface.faces());
            Some(volume_of_region(vertices, faces, id) / self.max_volume(id)?)
        };
        let regions = self.document.regions.iter();
        regions.filter_map(|r| of_region(r.id)).sum()
    }

    /// What will be asked of a template's surface, if it is remeshed; sizes that change from place to place count by their mean.
    pub fn asked(&self, template: &Template) -> Option<Asked> {
        let for_lengths = self.document.moves_for_lengths();
        if !for_lengths && self.is_kept() {
            return None;
        }
        let (wishes, radius) = (&self.document.wishes, self.tolerance.extent().radius);
        let regions = &self.document.regions;
        let length_in = |id: u32| {
            let at = regions.binary_search_by_key(&id, |r| r.id).ok()?;
            let asked = regions[at]
                .size
                .or(wishes.size)
                .and_then(|s| s.edge_length());
            let mean = self.mean_volume.map(edge_of_volume);
            asked.into_iter().chain(mean).reduce(f64::min)
        };
        let length = |t: &Triangle| {
            let sides = [t.front, t.back].into_iter().filter_map(length_in);
            sides.fold(f64::INFINITY, f64::min)
        };
        let length: Vec<f64> = template.triangles.iter().map(length).collect();
        let finite = length.iter().copied().filter(|l| l.is_finite());
        let longest = finite.reduce(f64::max).filter(|_| for_lengths);
        let room = longest.map_or(0.0, |longest| wishes.room_for(longest, radius));
        let noise = (radius * self.deviation()).max(self.tolerance.equal());
        Some(Asked {
            turn: wishes.turn(),
            turn_is_asked: wishes.segments_per_turn.is_some(),
            growth: wishes.gradation() - 1.0,
            feature: libm::cos(wishes.feature_angle().to_radians()),
            deviation: room.max(noise),
            noise,
            flat: self.tolerance.flat(),
            folds: self.document.unevenness(),
            length,
        })
    }

    /// How far surfaces may move, relative to the radius about the axis.
    fn deviation(&self) -> f64 {
        self.document.deviation(self.equal())
    }

    /// What is equal, relative to the radius about the axis.
    fn equal(&self) -> f64 {
        self.tolerance.equal() / self.tolerance.extent().radius
    }

    /// Whether every triangle of the surface stays as it is drawn.
    pub fn is_kept(&self) -> bool {
        self.deviation() <= self.equal()
    }

    /// The cosine of the angle at a feature edge, where the surface will be remeshed: between features, what is narrow costs nothing then.
    pub fn feature(&self) -> Option<f64> {
        let angle = self.document.wishes.feature_angle().to_radians();
        (!self.is_kept()).then(|| libm::cos(angle))
    }

    /// Whether surfaces will get edges of a length that is asked for, longer ones than those that there are, too, however they are
    /// drawn: where the input has not its symmetry exactly.
    pub fn takes_lengths(&self) -> bool {
        self.document.moves_for_lengths() && !self.is_kept()
    }

    /// The size of elements beside a triangle, model units: as asked for, at most that of the body.
    pub fn element_size(&self) -> impl Fn(&Triangle) -> f64 {
        let vertices = self.surface.vertices.iter().copied();
        let low = vertices.clone().reduce(DVec3::min);
        let high = vertices.reduce(DVec3::max);
        let extent = low.zip(high).map_or(0.0, |(a, b)| a.distance(b));
        move |t| {
            let cap = |region| self.max_volume(region).map(edge_of_volume);
            let caps = [t.front, t.back].into_iter().filter_map(cap);
            caps.fold(extent, f64::min)
        }
    }

    /// Whether each vertex stays where it is, as far as is known: where the surface will be remeshed, those on features do.
    pub fn stay(&self) -> Vec<bool> {
        if self.is_kept() {
            return vec![true; self.surface.vertices.len()];
        }
        let mut stay = vec![false; self.surface.vertices.len()];
        let feature = libm::cos(self.document.wishes.feature_angle().to_radians());
        let triangles = &self.surface.triangles;
        let normal = |t: u32| {
            let [a, b, c] = geom::measure::corners(&self.surface.vertices, triangles[t as usize]);
            geom::measure::double_area_vector(a, b, c).normalize_or_zero()
        };
        let corners: Vec<[u32; 3]> = triangles.iter().map(|t| t.vertices).collect();
        let edges = Edges::new(&corners);
        for e in 0..edges.len() {
            let is_smooth = matches!(edges.around(e), [u, v]
                if normal(u.triangle).dot(normal(v.triangle)) > feature);
            if !is_smooth {
                edges.ends[e].iter().for_each(|&v| stay[v as usize] = true);
            }
        }
        stay
    }

    /// The points in the canonical frame.
    pub fn canonical(&self) -> Vec<DVec3> {
        let to_canonical = |&p| self.frame.to_canonical(p);
        self.surface.vertices.iter().map(to_canonical).collect()
    }
}

/// Volume of each region of a surface, model units cubed.
pub fn region_volumes(vertices: &[DVec3], triangles: &[Triangle]) -> BTreeMap<u32, f64> {
    let origin = vertices.first().copied().unwrap_or_default();
    let mut volumes = BTreeMap::new();
    for t in triangles {
        let [a, b, c] = geom::measure::corners(vertices, t);
        let volume = geom::measure::tet_volume(origin, a, b, c);
        for (region, sign) in [(t.back, 1.0), (t.front, -1.0)] {
            if region != OUTSIDE {
                *volumes.entry(region).or_default() += sign * volume;
            }
        }
    }
    volumes
}
