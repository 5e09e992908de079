//! Whether a change stays in the envelope, and keeps what must be kept.

use super::Mesh;
use super::change::{Change, Fitted, Sample};
use crate::shape::{Near, UPRIGHT};
use geom::measure::double_area_vector;
use geom::tree::closest_point;
use glam::DVec3;

/// Angle between what is the same direction but for rounding, radians: that of the corners of a needle, half of all digits, as
/// its height has as many fewer than its length.
const ROUNDING: f64 = 1.0 / (1_u64 << (f64::MANTISSA_DIGITS / 2)) as f64;

/// Height of a triangle over its longest edge below which it is none: no change leaves a flatter one than it replaces. A hundred times
/// what TetGen takes for one line; triangles of drawings are a hundred times as high and more, but where noise makes them.
const FLAT: f64 = 1e-6;

impl Mesh<'_> {
    /// Whether a change keeps to the rules; where the input's points are then.
    pub fn fit(&self, change: &Change) -> Option<Fitted> {
        let is_held = |t: &u32| {
            self.triangles[*t as usize]
                .iter()
                .all(|&v| self.held[v as usize])
        };
        if change.gone.iter().any(is_held) {
            return None;
        }
        if !change
            .new
            .iter()
            .all(|&(t, patch)| self.is_sound(change, t, patch))
        {
            return None;
        }
        if !self.holds_edges(change) || !self.keeps_heights(change) {
            return None;
        }
        let fitted = Fitted {
            samples: self.samples_of(change)?,
            on_chords: self.samples_on_chords(change)?,
        };
        self.keeps_angles(change).then_some(fitted)
    }

    /// Where the samples of the triangles that go are then: near the new ones of their patch, or of any where the patch is
    /// gone and joining may take it.
    fn samples_of(&self, change: &Change) -> Option<Vec<Vec<Sample>>> {
        let at = |v: u32| self.points[v as usize];
        let mut samples = vec![Vec::new(); change.new.len()];
        for &t in &change.gone {
            let patch = self.patch[t as usize];
            let stays = change.new.iter().any(|n| n.1 == patch);
            let may_go = match change.joins {
                true => !self.keeps[patch as usize] || self.goes_on(t, change),
                false => self.samples[t as usize].is_empty(),
            };
            if !stays && !may_go {
                if !self.is_cut_off(t, change) {
                    return None;
                }
                continue;
            }
            for sample in &self.samples[t as usize] {
                let distance = |corners: [u32; 3]| {
                    closest_point(sample.point, &corners.map(at)).distance(sample.point)
                };
                let new = change.new.iter().enumerate();
                // What goes with a detail, though its patch stays, may be near to any triangle in its place.
                let is_any = !stays || change.moved.is_some() && change.joins;
                let new = new.filter(|(_, n)| n.1 == patch || is_any);
                let each = new.map(|(i, n)| (distance(n.0), i));
                let (nearest, i) = each.min_by(|x, y| x.0.total_cmp(&y.0))?;
                let reach = match is_any {
                    true => self.rules.deviation,
                    false => sample.reach,
                };
                if nearest > reach {
                    return None;
                }
                samples[i].push(Sample { reach, ..*sample });
            }
        }
        Some(samples)
    }

    /// Whether a triangle goes because the border of its flat face goes along its third side then. What the face ends at counts from there on: points of the
    /// face that are beyond its border are as far from it as that is from where it was.
    fn is_cut_off(&self, t: u32, change: &Change) -> bool {
        let patch = self.patch[t as usize];
        let third = (change.chords.iter()).find(|chord| {
            let corners = self.triangles[t as usize];
            chord.0.iter().all(|v| corners.contains(v))
        });
        let Some(&(ends, _)) = third.filter(|_| self.planes[patch as usize].is_some()) else {
            return false;
        };
        let [a, b] = ends.map(|v| self.points[v as usize]);
        self.goes_on(t, change)
            && self.samples[t as usize].iter().all(|sample| {
                geom::measure::distance_to_segment(sample.point, a, b) <= sample.reach
            })
    }

    /// Whether triangles of the same patch stay around one that goes.
    fn goes_on(&self, t: u32, change: &Change) -> bool {
        let patch = self.patch[t as usize];
        let corners = self.triangles[t as usize].into_iter();
        let mut around = corners.flat_map(|v| self.around(v));
        around.any(|other| self.patch[*other as usize] == patch && !change.gone.contains(other))
    }

    /// Where the samples of the feature edges that go are then.
    fn samples_on_chords(&self, change: &Change) -> Option<Vec<Vec<Sample>>> {
        let at = |v: u32| self.points[v as usize];
        let mut on_chords = vec![Vec::new(); change.chords.len()];
        for ends in &change.chords_gone {
            for sample in self.on_chords.get(ends).into_iter().flatten() {
                let distance = |[a, b]: [u32; 2]| {
                    geom::measure::distance_to_segment(sample.point, at(a), at(b))
                };
                let each = change.chords.iter().enumerate();
                let each = each.map(|(i, c)| (distance(c.0), i));
                let (nearest, i) = each.min_by(|x, y| x.0.total_cmp(&y.0))?;
                let reach = sample.reach.max(self.slack(change, change.chords[i]));
                if nearest > reach {
                    return None;
                }
                on_chords[i].push(Sample { reach, ..*sample });
            }
        }
        Some(on_chords)
    }

    /// How far a feature edge of a curve may be from where that was in any case. Of a curve that another one was joined to before, edges get as long as
    /// those of others, and may be no farther than walls are to stay walls.
    fn slack(&self, change: &Change, (ends, curve): ([u32; 2], u32)) -> f64 {
        match self.loose[curve as usize] {
            _ if change.joins => self.rules.deviation,
            true => self.deviation_at(&ends),
            false => 0.0,
        }
    }

    /// Whether a triangle of a patch lies in a wall that the patch is no part of. Copies of the body would touch there.
    fn lies_in_wall(&self, corners: [u32; 3], patch: u32) -> bool {
        let [a, b, c] = corners.map(|v| self.bound[v as usize]);
        a & b & c & !self.planes_of[patch as usize] != 0 || self.images.lies_in_face(corners, patch)
    }

    /// Whether a patch lies in a wall or a glued face: where the body was cut.
    pub fn is_cut(&self, patch: u32) -> bool {
        self.planes_of[patch as usize] != 0 || self.images.faces[patch as usize] != 0
    }

    /// Whether a new triangle faces as one of its patch does that goes, but for rounding: as what is cut out of it. Needles along
    /// the edge of something thin face anywhere, and would stay as they are if their parts had to face as the shape does. Not
    /// where a vertex was moved: what is there instead has the same corners, and could be folded over.
    fn faces_as_before(&self, change: &Change, vector: DVec3, patch: u32) -> bool {
        let gone = change.gone.iter().map(|&t| t as usize);
        let mut before = gone
            .filter(|&t| change.moved.is_none() && self.patch[t] == patch)
            .map(|t| self.vector(self.triangles[t]));
        before.any(|old| {
            let product = old.length() * vector.length();
            old.dot(vector) > 0.0 && old.cross(vector).length() <= ROUNDING * product
        })
    }

    /// The cosine of the angle between a triangle and the shape of its patch; `None` where that has no direction.
    fn uprightness(&self, [a, b, c]: [DVec3; 3], patch: u32) -> Option<f64> {
        let normal = self.envelope.at(patch, (a + b + c) / 3.0)?.0;
        Some(double_area_vector(a, b, c).normalize_or_zero().dot(normal))
    }

    /// The cosine that triangles of a patch have to be above which a change leaves though they are not upright: that of the worst of those that go,
    /// where a vertex inside of a patch does. Needles narrower than the surface may be off its shape lean as they like, and what
    /// takes the place of some may lean as well; a curve that moves with them would fold what is beyond it.
    fn least_upright(&self, change: &Change, patch: u32) -> f64 {
        if change.new.len() >= change.gone.len() || !change.chords_gone.is_empty() {
            return UPRIGHT;
        }
        let gone = change.gone.iter().map(|&t| t as usize);
        let of_patch = gone.filter(|&t| self.patch[t] == patch);
        let upright = of_patch.filter_map(|t| {
            let corners = self.triangles[t].map(|v| self.before(change, v));
            self.uprightness(corners, patch)
        });
        upright.fold(UPRIGHT, f64::min).max(0.0)
    }

    /// Where a vertex was before a change.
    pub fn before(&self, change: &Change, v: u32) -> DVec3 {
        match change.moved {
            Some((moved, place)) if moved == v => place,
            _ => self.points[v as usize],
        }
    }

    /// Whether no triangle is flatter than those that go, if it is flat.
    fn keeps_heights(&self, change: &Change) -> bool {
        let height = |[a, b, c]: [DVec3; 3]| {
            let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
            double_area_vector(a, b, c).length() / (longest * longest)
        };
        let lowest = |heights: &mut dyn Iterator<Item = f64>| heights.fold(f64::INFINITY, f64::min);
        let new = change.new.iter().map(|n| n.0);
        let after = lowest(&mut new.map(|t| height(t.map(|v| self.points[v as usize]))));
        after >= FLAT || {
            let gone = change.gone.iter().map(|&t| self.triangles[t as usize]);
            after >= lowest(&mut gone.map(|t| height(t.map(|v| self.before(change, v)))))
        }
    }

    /// Twice the area of a triangle, along its normal.
    fn vector(&self, corners: [u32; 3]) -> DVec3 {
        let [a, b, c] = corners.map(|v| self.points[v as usize]);
        double_area_vector(a, b, c)
    }

    /// Whether a new triangle has area, faces as the shape does, is in no wall and not there already.
    fn is_sound(&self, change: &Change, corners: [u32; 3], patch: u32) -> bool {
        let [a, b, c] = corners.map(|v| self.points[v as usize]);
        let vector = double_area_vector(a, b, c);
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        let area = vector.length();
        if area <= self.rules.flat * longest || self.lies_in_wall(corners, patch) {
            return false;
        }
        let upright = match &self.planes[patch as usize] {
            Some(plane) => {
                vector.dot(plane.normal) >= UPRIGHT * area
                    && plane.off([a, b, c]) <= self.off[patch as usize]
            }
            None => {
                let upright = self.uprightness([a, b, c], patch);
                upright.is_some_and(|u| u >= UPRIGHT || u > self.least_upright(change, patch))
                    || self.faces_as_before(change, vector, patch)
            }
        };
        upright && {
            let is_same = |t: &&u32| {
                let other = self.triangles[**t as usize];
                corners.iter().all(|v| other.contains(v))
            };
            let around = self.around(corners[0]);
            around
                .iter()
                .filter(is_same)
                .all(|t| change.gone.contains(t))
        }
    }

    /// Whether new edges are inside the envelope.
    fn holds_edges(&self, change: &Change) -> bool {
        let was_moved = |v: u32| change.moved.is_some_and(|moved| moved.0 == v);
        let old = |a: u32, b: u32| {
            !was_moved(a)
                && !was_moved(b)
                && change.gone.iter().any(|&t| {
                    let corners = self.triangles[t as usize];
                    corners.contains(&a) && corners.contains(&b)
                })
        };
        let at = |v: u32| self.points[v as usize];
        // Where faces meet is as far from what is beside them as they were apart.
        let slack = match change.joins && change.moved.is_some() {
            true => self.rules.deviation,
            false => 0.0,
        };
        let chords = change.chords.iter().all(|&([a, b], curve)| {
            let slack = self.slack(change, ([a, b], curve));
            self.envelope
                .holds(Near::Curve(curve), [at(a), at(b)], slack)
        });
        chords
            && change.new.iter().all(|&(corners, patch)| {
                self.planes[patch as usize].is_some()
                    || (0..3).all(|i| {
                        let (a, b) = (corners[i], corners[(i + 1) % 3]);
                        let key = [a.min(b), a.max(b)];
                        let is_chord = change.chords.iter().any(|c| c.0 == key)
                            || self.curve(a, b).is_some();
                        is_chord
                            || old(a, b)
                            // Both triangles at an edge have it; one of them looks.
                            || (a > b && change.new.iter().any(|n| n.0.contains(&a) && n.0.contains(&b) && n.0 != corners))
                            || self.envelope.holds(Near::Patch(patch), [at(a), at(b)], slack)
                    })
            })
    }
}
