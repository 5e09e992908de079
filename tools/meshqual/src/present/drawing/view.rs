//! How a mesh is looked at in pictures.

use super::layout::LAYOUT;
use geom::tolerance::PROMISE;
use glam::{DMat3, DVec3};
use tmesh::Document;

/// How the mesh is looked at: from above, with the axis upright.
#[derive(Clone, Copy)]
pub struct View {
    rotation: DMat3,
    /// From the frame of the document to that of the axis.
    upright: DMat3,
    middle: DVec3,
    scale: f64,
    /// Towards the eye, along the ground.
    towards: DVec3,
    centre: DVec3,
    /// Up to this a vertex beyond the cutting plane counts as on it, model units.
    on_plane: f64,
}

impl View {
    /// The view that shows all of a document.
    pub fn of(document: &Document) -> Self {
        let (elevation, azimuth) = LAYOUT.eye.map(f64::to_radians).into();
        let (se, ce) = (libm::sin(elevation), libm::cos(elevation));
        let (sa, ca) = (libm::sin(azimuth), libm::cos(azimuth));
        let eye = DVec3::new(ce * ca, ce * sa, se);
        let right = DVec3::new(-sa, ca, 0.0);
        // The axis of an assembled mesh lies anywhere.
        let promise = document.promise.as_ref();
        let (upright, origin) = match promise.filter(|_| document.is_plain()) {
            Some(p) => (
                DMat3::from_cols_array_2d(&p.rotation),
                DVec3::from_array(p.origin),
            ),
            None => (DMat3::IDENTITY, DVec3::ZERO),
        };
        let rotation = DMat3::from_cols(right, eye.cross(right), eye).transpose() * upright;
        let mut view = Self {
            rotation,
            upright,
            middle: DVec3::ZERO,
            scale: 1.0,
            towards: DVec3::new(ca, sa, 0.0),
            centre: origin,
            on_plane: PROMISE * document.diagonal(),
        };
        view.fit(document, |_| true);
        if promise.is_none() && document.is_plain() {
            // Nothing is known of an axis: cut through the middle.
            view.centre = rotation.transpose() * view.middle;
        }
        view
    }

    /// The view that shows what is behind the plane through the axis, or all if there is nothing.
    pub fn behind(document: &Document) -> Self {
        let mut view = Self::of(document);
        let all = view;
        view.fit(document, |p| all.is_behind(p));
        view
    }

    /// Makes the placed vertices that are shown fill the picture.
    fn fit(&mut self, document: &Document, shown: impl Fn(DVec3) -> bool) {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for instance in &document.instances {
            let placed = instance.isometry.placed();
            let vertices = document.templates[instance.template as usize]
                .vertices
                .iter();
            for p in vertices.map(|&p| placed.apply(p)).filter(|&p| shown(p)) {
                let q = self.rotation * p;
                low = low.min(q);
                high = high.max(q);
            }
        }
        if low.x <= high.x {
            let size = high - low;
            self.middle = 0.5 * (low + high);
            let fit = |pixels: usize, extent: f64| {
                LAYOUT.fill * (pixels * LAYOUT.samples) as f64 / extent.max(f64::MIN_POSITIVE)
            };
            self.scale = fit(LAYOUT.width, size.x).min(fit(LAYOUT.height, size.y));
        }
    }

    /// Samples to the right, samples down, and depth towards the eye.
    pub fn see(&self, p: DVec3) -> DVec3 {
        let q = (self.rotation * p - self.middle) * self.scale;
        let half = [LAYOUT.width, LAYOUT.height].map(|n| 0.5 * (n * LAYOUT.samples) as f64);
        DVec3::new(half[0] + q.x, half[1] - q.y, q.z)
    }

    /// Whether a point lies behind the plane through the axis that faces the eye, or on it.
    pub fn is_behind(&self, p: DVec3) -> bool {
        (self.upright * (p - self.centre)).dot(self.towards) <= self.on_plane
    }
}
