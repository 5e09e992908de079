//! Solids that cross, overlap or touch with different triangles, and those that cross themselves, with sides.

use super::solids::Labels;
use super::surface::{NONE, Surface};
use crate::contacts::{Changed, Claimed, Contacts, Joined, Overlap};
use crate::imprint::{
    Claim, Complex, Curves, Faces, Incidence, Reach, Settled, is_related, overlay, settle,
};
use crate::interface::{Drawn, draw_once};
use crate::meeting::{Met, contacts_within, meetings, meetings_within};
use crate::words::{place, short};
use geom::contacts::contacts;
use geom::edges::{EdgeUse, Edges};
use geom::measure::tet_volume;
use geom::tolerance::Tolerance;
use interchange::text::counted;
use rustc_hash::{FxHashMap, FxHashSet};
use tmesh::{OUTSIDE, Template, Triangle};

/// A surface whose triangles meet in common vertices and edges only, and the solids on its sides.
pub struct Imprinted {
    /// The surface.
    pub surface: Surface,
    /// The solids on either side of its triangles.
    pub labels: Labels,
    /// What was done.
    pub joined: Joined,
    /// Of each claim in that: who has the space, and whose it was.
    claims: Vec<[u32; 2]>,
    /// How thick the thinnest claim is that one solid makes of another one that is not inside of it, model units; infinite where there is none.
    pub thinnest: f64,
    /// Whether all that was done is to take out what a single solid, or its parts, have twice, and that is less of it than single
    /// precision tells: noise makes thin layers cross, and what is taken out leaves slivers.
    pub is_slight: bool,
    /// The volume that solids have more than once by themselves, model units cubed.
    doubled: f64,
    /// What the solids were before, where facets of both were divided at each other.
    pub divided: Option<Divided>,
}

/// Solids whose facets were divided at each other where they touch along curved faces: interfaces may be drawn once instead.
#[derive(Clone, Debug)]
pub struct Divided {
    surface: Surface,
    complex: Complex,
    tolerance: Tolerance,
    contacts: Contacts,
    crossing: Crossing,
}

impl Divided {
    /// The complex with the facets of one solid for both where curved faces touch; `None` where there is no such contact, or what would come of it
    /// crosses or loses something.
    pub fn drawn_once(&self) -> Option<Imprinted> {
        let Self {
            surface,
            complex,
            tolerance,
            contacts,
            crossing,
        } = self;
        let drawn = draw_once(surface, complex, tolerance.equal(), contacts.gap)?;
        interfaces_once(surface, &drawn, tolerance, contacts.flat(), crossing)
    }
}

/// Why solids are no one complex.
pub struct Unjoined {
    /// For the end of a sentence.
    pub reason: String,
    /// Whether coordinates that are known less well than was thought may be why.
    pub may_be_rounding: bool,
}

impl Unjoined {
    fn by_rounding(reason: String) -> Self {
        Self {
            reason,
            may_be_rounding: true,
        }
    }
}

/// Makes one complex of the triangles of all solids. Where what touches within facets cannot be joined, as it overlaps by
/// more elsewhere, where nothing would be left of a solid that is thinner than facets explain, or where solids claim more of each other's
/// space once they are joined than before, so that what looked like a contact is none, faces are divided where they cross; not
/// where the gap was asked for. What meets of different faces may be `known`.
///
/// # Errors
/// Why that is not possible.
pub fn imprinted(
    surface: &Surface,
    tolerance: &Tolerance,
    contacts: Contacts,
    known: Option<&Met>,
) -> Result<Imprinted, Unjoined> {
    let mut complex = complex_of(surface, tolerance);
    let crossing = Crossing::of(surface, &complex, known);
    complex.break_up(&crossing.folded);
    let again = complex.clone();
    let as_read = |complex: Complex| Solids {
        surface,
        complex,
        moved: 0.0,
    };
    let mut first = attempt(as_read(complex), tolerance, contacts, &crossing);
    let flat = contacts.flat();
    let divided = Divided {
        surface: surface.clone(),
        complex: again,
        tolerance: *tolerance,
        contacts,
        crossing,
    };
    // What is drawn alike all around stays so where facets of both are divided: flips would not be alike.
    if let Ok(made) = &mut first
        && (contacts.gap.is_some() || made.is_clean())
    {
        made.divided = (contacts.gap.is_none() && made.joined.points > 0).then_some(divided);
        return first;
    }
    if contacts != flat
        && let Some(once) = divided.drawn_once()
    {
        return Ok(once);
    }
    let Divided {
        complex, crossing, ..
    } = divided;
    match (first, attempt(as_read(complex), tolerance, flat, &crossing)) {
        (Ok(first), Ok(second)) => {
            let is_better = first.has_all() && first.claimed() <= second.claimed();
            // What is lost in both is lost to other solids.
            Ok(if is_better { first } else { second })
        }
        (Err(_), second) => second,
        (first, Err(_)) => first,
    }
}

/// The complex of solids with interfaces that are drawn once, which is divided where it crosses; `None` where solids cross
/// themselves that did not, or some that share facets claim each other's space; others do so only if they did in the file.
/// `surface` has the solids as they are there.
fn interfaces_once(
    surface: &Surface,
    once: &Drawn,
    tolerance: &Tolerance,
    flat: Contacts,
    crossing: &Crossing,
) -> Option<Imprinted> {
    let complex = complex_of(&once.surface, tolerance);
    let after = Crossing::of(&once.surface, &complex, None);
    if after.solids != crossing.solids {
        return None;
    }
    let solids = Solids {
        surface: &once.surface,
        complex,
        moved: once.largest,
    };
    let mut made = attempt(solids, tolerance, flat, &after).ok()?;
    if !made.has_all() || made.claimed_between(|pair| once.pairs.contains(&pair)) > 0.0 {
        return None;
    }
    made.joined.volumes = volumes(surface);
    if !crossing.solids.contains(&true) {
        made.joined.drawn = drawn(surface);
    }
    Some(made)
}

impl Imprinted {
    /// Whether any of the solids touch or overlap.
    pub fn have_met(&self) -> bool {
        self.joined.interfaces > 0 || !self.joined.overlaps.is_empty()
    }

    /// The same, where the solids are parts of a single one, `whole`: what lies between them is within it.
    pub fn united(mut self, whole: &Surface) -> Self {
        let overlaps = self.joined.overlaps.iter().map(|c| c.volume);
        let twice = overlaps.sum::<f64>() + self.doubled;
        self.is_slight = is_slight(twice, &self.joined.volumes);
        let Labels { front, back, .. } = &mut self.labels;
        let is_outside: Vec<bool> = front.iter().map(|&s| s == NONE).collect();
        self.surface.retain(|t| is_outside[t]);
        front.retain(|&s| s == NONE);
        let count = front.len();
        *back = vec![0; count];
        self.labels.turned.truncate(count);
        self.labels.notices = vec![union_of_parts("the surface", twice)];
        self.surface.solid.fill(0);
        self.surface.partner.fill(NONE);
        self.surface.solids.clone_from(&whole.solids);
        self.joined.interfaces = 0;
        self.joined.overlaps.clear();
        self.joined.volumes = volumes(whole);
        self.joined.is_united = true;
        for t in self.joined.drawn.iter_mut().flat_map(|d| &mut d.triangles) {
            t.back = 1;
        }
        self.claims.clear();
        self
    }

    /// Whether something is left of each solid.
    fn has_all(&self) -> bool {
        let sides = self.labels.front.iter().chain(&self.labels.back);
        let there: FxHashSet<u32> = sides.copied().filter(|&s| s != NONE).collect();
        there.len() == self.surface.solids.len()
    }

    /// Whether something is left of each solid, and none claims space of another one.
    fn is_clean(&self) -> bool {
        self.has_all() && self.claimed() == 0.0
    }

    /// The volume that solids claim of each other, model units cubed, but for those that lie inside of others.
    fn claimed(&self) -> f64 {
        self.claimed_between(|_| true)
    }

    /// The same of some pairs of solids, which are given with the lower one first.
    fn claimed_between(&self, some: impl Fn([u32; 2]) -> bool) -> f64 {
        let claims = self.joined.overlaps.iter().zip(&self.claims);
        let between = claims.filter(|(c, [a, b])| !c.nested && some([*a.min(b), *a.max(b)]));
        between.map(|(c, _)| c.volume).sum()
    }
}

/// Solids to be made one complex.
struct Solids<'a> {
    surface: &'a Surface,
    complex: Complex,
    /// How far anything of them was moved before, model units.
    moved: f64,
}

fn attempt(
    solids: Solids<'_>,
    tolerance: &Tolerance,
    contacts: Contacts,
    crossing: &Crossing,
) -> Result<Imprinted, Unjoined> {
    let Solids {
        surface,
        complex,
        moved,
    } = solids;
    let solid = &surface.solid;
    let (crosses_itself, meeting) = (&crossing.solids, crossing.pairs.as_slice());
    let overlay = overlay(complex, (solid, meeting), tolerance.equal(), contacts.gap);
    let complex = &overlay.complex;
    let met = match overlay.done {
        true => meetings_within(&complex.points, &complex.triangles, &complex.face),
        false => meetings(&complex.points, &complex.triangles, |t| t, |_| true),
    };
    if let Some(first) = met.lowest {
        let (one, many) = ("pair of triangles is left", "pairs of triangles are left");
        return Err(Unjoined::by_rounding(format!(
            "they could not be made one complex: {} that cross, the first at {}",
            counted(met.count, one, many),
            place(first.point)
        )));
    }
    let Some(settled) = settle(complex, solid, crosses_itself, contacts.overlap) else {
        let reason = "what is inside them cannot be told";
        return Err(Unjoined::by_rounding(reason.to_owned()));
    };
    if contacts.overlap == Overlap::Refuse
        && let Some(first) = settled
            .overlaps
            .iter()
            .find(|c| !c.nested && c.thickness > tolerance.equal())
    {
        let reason = format!(
            "{} and {} overlap by a volume of {}, which --overlap refuse does not allow",
            surface.solid_name(first.loser.min(first.winner)),
            surface.solid_name(first.loser.max(first.winner)),
            short(first.volume)
        );
        return Err(Unjoined {
            reason,
            may_be_rounding: false,
        });
    }
    let mut joined = joined(
        surface,
        &settled,
        (overlay.largest.max(moved), overlay.added),
        tolerance,
    );
    if !crosses_itself.contains(&true) {
        joined.drawn = drawn(surface);
    }
    let notices = notices(surface, &settled, &joined, tolerance);
    let doubled: f64 = settled.doubled.iter().map(|d| d.1).sum();
    let is_slight = surface.solids.len() == 1 && is_slight(doubled, &joined.volumes);
    let thick = || thick_overlaps(&settled, tolerance);
    let between = thick().filter(|c| !c.nested);
    Ok(Imprinted {
        divided: None,
        claims: thick().map(|c| [c.winner, c.loser]).collect(),
        thinnest: between.map(|c| c.thickness).fold(f64::INFINITY, f64::min),
        is_slight,
        doubled,
        labels: labels(&settled, notices),
        surface: sided(surface, complex, &settled),
        joined,
    })
}

fn complex_of(surface: &Surface, tolerance: &Tolerance) -> Complex {
    let alike = |s: u32, t: u32| {
        let of = |t: u32| (surface.solid[t as usize], surface.group[t as usize]);
        of(s) == of(t)
    };
    Complex::new(
        surface.points.clone(),
        surface.triangles.clone(),
        tolerance.flat(),
        alike,
    )
}

/// How solids that touch without crossing and with different triangles are to be taken; `None` where there are none. Solids
/// that share triangles are drawn with each other in mind: what facets explain elsewhere is meant to be apart, and only
/// what rounding explains is one.
pub fn touching(surface: &Surface, tolerance: &Tolerance, contacts: Contacts) -> Option<Contacts> {
    let mut complex = complex_of(surface, tolerance);
    let edges = Edges::new(&surface.triangles);
    let faces = Faces::new(&complex, &edges);
    let curves = Curves::new(&complex, &edges, &surface.solid, contacts.gap);
    let incidence = Incidence {
        edges: &edges,
        faces: &faces,
    };
    let solid_of = |t: u32| surface.solid[t as usize];
    let shared = Shared::of(surface);
    let joined = |a: u32, b: u32| shared.solids.contains(&[a.min(b), a.max(b)]);
    let mut any = |wanted: &dyn Fn(u32, u32) -> bool, curves: Option<&Curves>| {
        let reach = Reach {
            equal: tolerance.equal(),
            curves,
        };
        let some = (shared.others.as_slice(), wanted);
        is_related(&mut complex, incidence, solid_of, some, reach)
    };
    let curved = (contacts.gap != Some(0.0)).then_some(&curves);
    if any(&|a, b| !joined(a, b), curved) {
        return Some(contacts);
    }
    any(&joined, None).then_some(contacts.flat())
}

/// What solids have in common.
struct Shared {
    /// Pairs of solids that have the same triangle, to the bit of its corners; the lower one first.
    solids: FxHashSet<[u32; 2]>,
    /// The triangles that one solid has, in order. Behind the others there is a solid on either side: what touches them
    /// overlaps one of the two.
    others: Vec<u32>,
}

impl Shared {
    fn of(surface: &Surface) -> Self {
        let bits = |v: u32| surface.points[v as usize].to_array().map(f64::to_bits);
        let mut seen: FxHashMap<[[u64; 3]; 3], u32> = FxHashMap::default();
        let mut solids = FxHashSet::default();
        let mut is_shared = vec![false; surface.triangles.len()];
        for (t, corners) in (0..).zip(&surface.triangles) {
            let mut key = corners.map(bits);
            key.sort_unstable();
            let Some(other) = seen.insert(key, t) else {
                continue;
            };
            let [a, b] = [t, other].map(|t| surface.solid[t as usize]);
            if a != b {
                solids.insert([a.min(b), a.max(b)]);
                is_shared[t as usize] = true;
                is_shared[other as usize] = true;
            }
        }
        let others = (0..surface.triangles.len() as u32).filter(|&t| !is_shared[t as usize]);
        Self {
            solids,
            others: others.collect(),
        }
    }
}

/// What meets away from common vertices and edges.
#[derive(Clone, Debug)]
struct Crossing {
    /// Which solids have triangles that do.
    solids: Vec<bool>,
    /// The pairs of them, the lower one first.
    pairs: Vec<[u32; 2]>,
    /// Faces that have triangles which do.
    folded: FxHashSet<u32>,
}

impl Crossing {
    fn of(surface: &Surface, complex: &Complex, known: Option<&Met>) -> Self {
        let mut crossing = Self {
            solids: vec![false; surface.solids.len()],
            pairs: Vec::new(),
            folded: FxHashSet::default(),
        };
        let mut add = |triangles: [u32; 2]| {
            let [a, b] = triangles.map(|t| surface.solid[t as usize]);
            if a == b {
                crossing.solids[a as usize] = true;
                crossing.pairs.push(triangles);
            }
            let [a, b] = triangles.map(|t| complex.face[t as usize]);
            if a == b {
                crossing.folded.insert(a);
            }
        };
        let (points, triangles) = (&surface.points, &surface.triangles);
        match known {
            Some(met) => {
                met.pairs.iter().for_each(|pair| add(*pair));
                contacts_within(points, triangles, &met.group, |c| add(c.triangles));
            }
            None => {
                contacts(
                    points,
                    triangles,
                    |t| t,
                    |contact| {
                        add(contact.triangles);
                        true
                    },
                );
            }
        }
        crossing
    }
}

fn sided(surface: &Surface, complex: &Complex, settled: &Settled) -> Surface {
    let of = |list: &[u32]| -> Vec<u32> {
        let sources = settled.triangles.iter().map(|t| t.1 as usize);
        sources.map(|s| list[s]).collect()
    };
    Surface {
        points: complex.points.clone(),
        triangles: settled.triangles.iter().map(|t| t.0).collect(),
        group: of(&surface.group),
        solid: settled.triangles.iter().map(|t| t.2[1]).collect(),
        partner: settled.triangles.iter().map(|t| t.2[0]).collect(),
        source: of(&surface.source),
        groups: surface.groups.clone(),
        solids: surface.solids.clone(),
        group_word: surface.group_word,
    }
}

fn labels(settled: &Settled, notices: Vec<String>) -> Labels {
    Labels {
        front: settled.triangles.iter().map(|t| t.2[0]).collect(),
        back: settled.triangles.iter().map(|t| t.2[1]).collect(),
        turned: vec![false; settled.triangles.len()],
        notices,
        crosses: false,
        is_apart: true,
        met: None,
    }
}

/// What solids claim of each other that rounding does not explain.
fn thick_overlaps<'a>(
    settled: &'a Settled,
    tolerance: &Tolerance,
) -> impl Iterator<Item = &'a Claim> {
    let equal = tolerance.equal();
    (settled.overlaps.iter()).filter(move |c| c.thickness > equal)
}

/// What was done, before volumes afterwards are known.
fn joined(
    surface: &Surface,
    settled: &Settled,
    (largest, points): (f64, usize),
    tolerance: &Tolerance,
) -> Joined {
    let name = |solid: u32| surface.solids[solid as usize].clone();
    let thick = thick_overlaps(settled, tolerance);
    Joined {
        drawn: None,
        is_united: false,
        interfaces: settled.triangles.iter().filter(|t| t.2[0] != NONE).count(),
        largest,
        points,
        overlaps: thick
            .map(|c| Claimed {
                by: name(c.winner),
                from: name(c.loser),
                volume: c.volume,
                nested: c.nested,
            })
            .collect(),
        volumes: volumes(surface),
    }
}

/// The volumes of solids before, model units cubed.
fn volumes(surface: &Surface) -> Vec<Changed> {
    let mut before = vec![0.0; surface.solids.len()];
    let origin = surface.corners(0)[0];
    for (t, &solid) in (0..).zip(&surface.solid) {
        let [a, b, c] = surface.corners(t);
        before[solid as usize] += tet_volume(origin, a, b, c);
    }
    let named = surface.solids.iter().zip(before);
    named
        .map(|(name, before): (&String, f64)| Changed {
            name: name.clone(),
            before: before.abs(),
            after: 0.0,
        })
        .collect()
}

/// The solids as they are drawn, each with vertices of its own, so that at an edge only triangles of one meet; none where
/// triangles of one are not oriented alike.
fn drawn(surface: &Surface) -> Option<Template> {
    let edges = Edges::new(&surface.triangles);
    let solid = |u: &EdgeUse| surface.solid[u.triangle as usize];
    for e in 0..edges.len() {
        for u in edges.around(e) {
            let of_it = || edges.around(e).iter().filter(|w| solid(w) == solid(u));
            if of_it().count() != 2 * of_it().filter(|w| w.forward).count() {
                return None;
            }
        }
    }
    let mut volumes = vec![0.0; surface.solids.len()];
    let origin = surface.corners(0)[0];
    for (t, &solid) in (0..).zip(&surface.solid) {
        let [a, b, c] = surface.corners(t);
        volumes[solid as usize] += tet_volume(origin, a, b, c);
    }
    let mut vertices = Vec::new();
    let mut own = FxHashMap::default();
    let mut own_vertex = |solid: u32, v: u32| {
        *own.entry((solid, v)).or_insert_with(|| {
            vertices.push(surface.points[v as usize]);
            vertices.len() as u32 - 1
        })
    };
    let triangles = surface.triangles.iter().zip(&surface.solid);
    let outwards = triangles.map(|(corners, &solid)| {
        let [a, b, c] = corners.map(|v| own_vertex(solid, v));
        Triangle {
            vertices: if volumes[solid as usize] < 0.0 {
                [a, c, b]
            } else {
                [a, b, c]
            },
            marker: 0,
            front: OUTSIDE,
            // Regions are numbered as solids are, from 1.
            back: solid + 1,
        }
    });
    Some(Template {
        triangles: outwards.collect(),
        vertices,
        ..Template::default()
    })
}

/// What was done, a sentence each.
fn notices(
    surface: &Surface,
    settled: &Settled,
    joined: &Joined,
    tolerance: &Tolerance,
) -> Vec<String> {
    let solids = surface.solids.len();
    let mut notices = Vec::new();
    let name = |solid: u32| match solids {
        1 => "the surface".to_owned(),
        _ => surface.solid_name(solid),
    };
    for &(solid, volume) in &settled.doubled {
        notices.push(union_of_parts(&name(solid), volume));
    }
    if joined.interfaces > 0 {
        let (one, many) = ("triangle", "triangles");
        notices.push(format!(
            "solids that touch have the same {} there; nothing was moved by more than {}",
            counted(joined.interfaces, one, many),
            short(joined.largest)
        ));
    }
    for claim in thick_overlaps(settled, tolerance) {
        let [winner, loser] = [claim.winner, claim.loser].map(name);
        notices.push(match claim.nested {
            true => format!("{winner} lies inside {loser}: its place is cut out of that"),
            false => format!(
                "{loser} and {winner} overlap by a volume of {}: {winner} has it",
                short(claim.volume)
            ),
        });
    }
    notices
}

/// Whether the volume that solids have more than once is there, but less than single precision tells of them.
fn is_slight(twice: f64, volumes: &[Changed]) -> bool {
    let volume: f64 = volumes.iter().map(|v| v.before).sum();
    twice > 0.0 && twice <= f64::from(f32::EPSILON) * volume
}

/// The sentence on a solid that crosses or touches itself; `twice` is the volume that it has more than once, model units cubed.
fn union_of_parts(name: &str, twice: f64) -> String {
    let twice = match twice > 0.0 {
        true => format!(", which have a volume of {} more than once", short(twice)),
        false => String::new(),
    };
    format!(
        "{name} crosses or touches itself: it is taken as the union of its parts{twice}; --solids shells makes each closed shell a solid"
    )
}
