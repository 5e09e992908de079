use crate::document::or_as_cut;
use crate::done::done;
use crate::fill::{fill, finish};
use crate::{Meshed, surfaces, tetrahedralize};
use bodies::wedges::{Grid, LEVEL, SIDE, WALL, coated_ring, prism, with_hub};
use geom::measure::{tet_volume, volume_of_region};
use glam::DVec3;
use improve::Leaves;
use kit::Failure;
use mesher::{
    Answer, Asks, Attempt, Change, Climb, Deadline, Description, Error, LADDER, Log, NO_FACE,
    Params, Piece, Plc, Sizes, TetGen,
};
use std::sync::Mutex;
use std::time::Duration;
use surface::failure;
use surface::{Guide, Shared, divided, mean_edge, settle_faces};
use tmesh::{Deviation, Document, OUTSIDE, Size, Template, Wishes, validate};

/// Fills a document as these wishes ask, its surface as it is.
fn filled(document: Document, wishes: &Wishes) -> Result<Meshed, Error> {
    let kept = Wishes {
        keep_surface: Some(true),
        ..wishes.clone()
    };
    settled_and_filled(document, &kept)
}

/// The same, with the surface made that the elements need.
fn settled_and_filled(mut document: Document, wishes: &Wishes) -> Result<Meshed, Error> {
    document.wishes = wishes.clone().over(&document.wishes);
    let params = Params::new(&document.wishes);
    tetrahedralize(document, &params, Log::new(&|_| ()))
}

/// The same, with everything checked that must hold.
fn mesh(document: Document, wishes: &Wishes) -> Result<Document, Error> {
    assert_eq!(validate(&document), []);
    let begun = document.clone();
    let done = filled(document, wishes)?.document;
    check(&begun, &done);
    Ok(done)
}

/// What cannot be made of a remeshed surface is made of the surface as it was cut, said, and leaves the deviation that was wished for. Other errors stay.
#[test]
fn what_remeshing_spoils_is_made_as_it_was_cut() {
    let mut document = prism(4);
    document.wishes.deviation = Some(Deviation::Auto);
    let fill = |spoils: bool, is_remeshed: bool| {
        let heard = Mutex::new(Vec::new());
        let hear = |line: &str| heard.lock().unwrap().push(line.to_owned());
        let make = |document: Document| match document.wishes.deviation {
            Some(Deviation::Within(0.0)) => {
                filled(document, &Wishes::default()).map_err(|error| (error.to_string(), false))
            }
            _ => Err(("facets cross".to_owned(), is_remeshed)),
        };
        let made = or_as_cut(document.clone(), make, |_| spoils, Log::new(&hear));
        (made, heard.into_inner().unwrap())
    };
    let (made, heard) = fill(true, true);
    let made = made.unwrap().document;
    assert_eq!(made.wishes.deviation, Some(Deviation::Auto));
    assert!(made.templates.iter().all(|t| !t.tets.is_empty()));
    let told = "the surface is not remeshed, as that cannot be filled: facets cross";
    assert_eq!(heard, [told]);
    for (spoils, is_remeshed) in [(false, true), (true, false)] {
        let (made, heard) = fill(spoils, is_remeshed);
        assert_eq!(
            (made.err().as_deref(), heard.len()),
            (Some("facets cross"), 0)
        );
    }
}

fn sized(max_volume: f64) -> Wishes {
    Wishes {
        size: Some(Size::MaxVolume(max_volume)),
        timeout: Some(120.0),
        ..Wishes::default()
    }
}

fn volume(template: &Template, region: u32) -> f64 {
    template
        .tets
        .iter()
        .filter(|t| t.region == region)
        .map(|t| {
            let [a, b, c, d] = t.vertices.map(|v| template.vertices[v as usize]);
            tet_volume(a, b, c, d)
        })
        .sum()
}

/// What holds after meshing, seen from outside of the code that makes it hold.
fn check(before: &Document, after: &Document) {
    assert_eq!(validate(after), []);
    assert_eq!(before.instances, after.instances);
    let templates = before.templates.iter().zip(&after.templates);
    for (index, (old, new)) in templates.enumerate() {
        assert!(!new.tets.is_empty());
        for t in &new.tets {
            let [a, b, c, d] = t.vertices.map(|v| new.vertices[v as usize]);
            assert!(tet_volume(a, b, c, d) > 0.0);
        }
        for region in &before.regions {
            let surface = volume_of_region(&old.vertices, old.faces(), region.id);
            let refined = volume_of_region(&new.vertices, new.faces(), region.id);
            let tets = volume(new, region.id);
            assert!(
                (surface - tets).abs() <= 1e-9 * surface.abs(),
                "{surface} {tets}"
            );
            assert!((surface - refined).abs() <= 1e-9 * surface.abs());
        }
        faces_match(new);
        // Every vertex is used, old ones come first.
        let mut used = vec![false; new.vertices.len()];
        for v in new.tets.iter().flat_map(|t| t.vertices) {
            used[v as usize] = true;
        }
        assert!(used.iter().all(|&u| u));
        for (v, corner) in corners(old).into_iter().enumerate() {
            assert!(!corner || new.vertices[v] == old.vertices[v], "{v}");
        }
        // Exactly the vertices on a wall's plane are on the wall; the same for the axis.
        for m in &new.gluings {
            if let Some(plane) = m.mirror_plane(index) {
                let extent = new
                    .vertices
                    .iter()
                    .fold(0.0_f64, |e, p| e.max(p.abs().max_element()));
                for (v, &p) in new.vertices.iter().enumerate() {
                    let listed = m.vertex_pairs.binary_search(&[v as u32; 2]).is_ok();
                    let near = plane.distance(p).abs() <= 1e-13 * extent;
                    // The two walls of a half space lie in one plane.
                    if m.step.n() > 1 || after.instances.len() > 2 {
                        assert_eq!(listed, near, "vertex {v} at {p} and {}", m.name);
                    }
                    assert!(near || !listed);
                    if m.step.k() == 0 && listed {
                        assert_eq!(p.y, 0.0);
                    }
                }
            }
        }
        if !old.axis.is_empty() {
            for (v, p) in new.vertices.iter().enumerate() {
                let listed = new.axis.binary_search(&(v as u32)).is_ok();
                assert_eq!(listed, p.x == 0.0 && p.y == 0.0, "{p}");
            }
        }
    }
}

/// Of each vertex, whether faces of three directions meet there, so that it cannot be anywhere else.
fn corners(template: &Template) -> Vec<bool> {
    let mut normals: Vec<Vec<DVec3>> = vec![Vec::new(); template.vertices.len()];
    for t in &template.triangles {
        let [a, b, c] = t.vertices.map(|v| template.vertices[v as usize]);
        let normal = (b - a).cross(c - a).normalize();
        for v in t.vertices {
            normals[v as usize].push(normal);
        }
    }
    let spans = |n: &Vec<DVec3>| {
        n.iter().any(|a| {
            let across = n.iter().map(|b| a.cross(*b));
            across
                .clone()
                .any(|x| n.iter().any(|c| x.dot(*c).abs() > 1e-3))
        })
    };
    normals.iter().map(spans).collect()
}

/// Each tet face is shared by two tets of one region, or is a surface triangle with the right
/// regions on its sides.
fn faces_match(template: &Template) {
    use std::collections::BTreeMap;
    // Sorted face: regions seen (front of the sorted order, back of it).
    let mut faces: BTreeMap<[u32; 3], [u32; 2]> = BTreeMap::new();
    let even = |t: [u32; 3]| {
        let mut s = t;
        s.sort_unstable();
        let even = [s, [s[1], s[2], s[0]], [s[2], s[0], s[1]]].contains(&t);
        (s, even)
    };
    for t in &template.tets {
        let [a, b, c, d] = t.vertices;
        // Faces counter-clockwise seen from inside.
        for face in [[a, b, c], [a, d, b], [b, d, c], [a, c, d]] {
            let (key, even) = even(face);
            let entry = faces.entry(key).or_insert([OUTSIDE; 2]);
            let side = &mut entry[usize::from(!even)];
            assert_eq!(*side, OUTSIDE, "two tets on one side of a face");
            *side = t.region;
        }
    }
    let mut differing = faces.values().filter(|r| r[0] != r[1]).count();
    for t in &template.triangles {
        let (key, even) = even(t.vertices);
        let mut wanted = [t.front, t.back];
        if !even {
            wanted.reverse();
        }
        assert_eq!(faces.get(&key), Some(&wanted));
        if t.front != t.back {
            differing -= 1;
        }
    }
    assert_eq!(
        differing, 0,
        "faces between regions without a surface triangle"
    );
}

#[test]
fn prisms_with_an_axis() {
    for order in [1, 3, 4, 16] {
        let done = mesh(prism(order), &sized(1e-3)).unwrap();
        let template = &done.templates[0];
        assert!(template.axis.len() > 2, "axis vertices were added");
        let surface = [SIDE, WALL, LEVEL];
        assert!(
            template
                .triangles
                .iter()
                .all(|t| surface.contains(&t.marker))
        );
        assert!(template.triangles.iter().any(|t| t.marker == LEVEL));
    }
}

#[test]
fn coatings_keep_their_region_and_may_have_a_size() {
    let done = mesh(coated_ring(16, 5e-3), &sized(0.01)).unwrap();
    let count = |d: &Document, r| d.templates[0].tets.iter().filter(|t| t.region == r).count();
    assert!(count(&done, 4) > 0 && count(&done, 9) > 0);

    // Optimization moves vertices after the sizes were met, and may exceed them.
    let mut small = coated_ring(16, 0.2);
    small.regions[1].size = Some(Size::MaxVolume(2e-6));
    for (optimize, limit) in [(180.0, 2e-6), (130.0, 4e-6)] {
        let wishes = Wishes {
            optimize: Some(optimize),
            ..Wishes::default()
        };
        let done = mesh(small.clone(), &wishes).unwrap();
        let template = &done.templates[0];
        let biggest = |region| {
            template
                .tets
                .iter()
                .filter(|t| t.region == region)
                .map(|t| {
                    let [a, b, c, d] = t.vertices.map(|v| template.vertices[v as usize]);
                    tet_volume(a, b, c, d)
                })
                .fold(0.0, f64::max)
        };
        assert!(biggest(9) <= limit && biggest(4) > 1e-5, "{}", biggest(9));
    }
}

#[test]
fn voids_stay_empty() {
    // A shell of region 2 around a core of region 0 with a void in it, off the axis.
    let document = Grid {
        order: 5,
        mirror: true,
        radii: &[0.3, 0.5, 0.6, 0.7, 0.9],
        turns: 5,
        heights: &[0.0, 0.2, 0.3, 0.4, 0.7],
        region: &|i, j, k| match (i, j, k) {
            (1, 2, 1) => OUTSIDE,
            (1..=2, 1..=3, 1..=2) => 0,
            _ => 2,
        },
    }
    .document();
    let done = mesh(document, &sized(1e-4)).unwrap();
    assert_eq!(done.regions.len(), 2);
}

#[test]
fn pieces_may_be_apart() {
    let document = Grid {
        order: 6,
        mirror: true,
        radii: &[0.0, 0.4, 0.5, 1.0],
        turns: 1,
        heights: &[0.0, 0.3, 0.4, 0.5],
        region: &|i, _, k| {
            if i == 1 || (i == 2 && k == 1) {
                OUTSIDE
            } else {
                7
            }
        },
    }
    .document();
    mesh(document, &sized(1e-3)).unwrap();
}

fn ratchet(order: u32) -> Document {
    Grid {
        order,
        mirror: false,
        radii: &[0.0, 0.25, 0.5, 0.75, 1.0],
        turns: 3,
        heights: &[0.0, 0.25, 0.5],
        region: &|i, j, k| match (i, j) {
            (3, 0) => OUTSIDE,
            _ => k as u32,
        },
    }
    .document()
}

#[test]
fn seams_are_preserved() {
    for order in [2, 3, 7, 12] {
        let before = ratchet(order);
        let done = filled(before.clone(), &sized(1e-3)).unwrap();
        assert!(done.advice.is_empty());
        check(&before, &done.document);
        let (old, new) = (
            &before.templates[0].gluings[0],
            &done.document.templates[0].gluings[0],
        );
        assert_eq!(old.vertex_pairs, new.vertex_pairs);
        assert_eq!(old.triangle_pairs.len(), new.triangle_pairs.len());
    }
}

#[test]
fn seams_that_nobody_settled_are_divided_as_the_elements_need() {
    let mut before = ratchet(7);
    before.wishes = sized(1e-3);
    let done = settled_and_filled(before.clone(), &sized(1e-3)).unwrap();
    assert!(done.advice.is_empty(), "{:?}", done.advice);
    let mut facts = done.facts.iter();
    assert!(
        facts.any(|fact| fact.contains("vertex pairs")),
        "{:?}",
        done.facts
    );
    assert_eq!(validate(&done.document), []);
    let pairs = |d: &Document| d.templates[0].gluings[0].triangle_pairs.len();
    assert!(pairs(&done.document) > pairs(&before));
    // Just what is made of it in two steps.
    let params = Params::new(&before.wishes);
    let surface = surfaces(before, &params, Log::new(&|_| ()))
        .unwrap()
        .document;
    let again = tetrahedralize(surface, &params, Log::new(&|_| ()))
        .unwrap()
        .document;
    assert_eq!(again.templates, done.document.templates);
    assert_eq!(again.wishes, done.document.wishes);
    // Nor is a filled one settled again.
    let mut filled_before = done.document;
    filled_before.wishes.keep_surface = None;
    let again = pairs(&filled_before);
    let done = settled_and_filled(filled_before, &sized(1e-3)).unwrap();
    assert_eq!(pairs(&done.document), again);
}

#[test]
fn a_surface_that_cannot_be_settled_stays_as_it_was_cut() {
    let by_length = Wishes {
        size: Some(Size::EdgeLength(0.2)),
        ..sized(1e-3)
    };
    for wishes in [sized(1e-3), by_length] {
        let mut document = ratchet(7);
        // Two masters of one flat facet whose images are not alike.
        let [image, _] = document.templates[0].gluings[0].triangle_pairs[0];
        let before = document.templates[0].gluings[0].triangle_pairs.len();
        document.templates[0].triangles[image as usize].marker += 1;
        let done = settled_and_filled(document, &wishes).unwrap();
        let seam = &done.document.templates[0].gluings[0];
        assert_eq!(seam.triangle_pairs.len(), before);
        let told = &done.advice[0];
        assert!(told.contains("stay as they were cut"), "{told}");
        assert!(!told.contains("--order"), "{told}");
    }
}

/// Where lengths of edges are asked for, faces of a seam and what is beside them have these rather than what the mesher makes of them, in one step as in
/// two.
#[test]
fn surfaces_with_seams_get_the_lengths_asked_for() {
    for (order, length) in [(7, 0.2), (12, 0.15)] {
        let mut before = ratchet(order);
        before.wishes.size = Some(Size::EdgeLength(length));
        let params = Params::new(&before.wishes);
        let log = Log::new(&|_| ());
        let done = tetrahedralize(before.clone(), &params, log).unwrap();
        assert_eq!(validate(&done.document), []);
        for region in &before.regions {
            let of = |d: &Document| {
                let t = &d.templates[0];
                volume_of_region(&t.vertices, t.faces(), region.id)
            };
            let (was, is) = (of(&before), of(&done.document));
            assert!((was - is).abs() <= 1e-12 * was.abs(), "{was} {is}");
        }
        let (mesher, _) =
            settle_faces(before.clone(), &mut [], &params, (log, Guide::Mesher)).unwrap();
        let mesher = tetrahedralize(mesher, &params, log).unwrap();
        let surface = surfaces(before.clone(), &params, log).unwrap();
        assert_eq!(validate(&surface.document), []);
        let again = tetrahedralize(surface.document, &params, log).unwrap();
        assert_eq!(again.document.templates, done.document.templates);
        let means = [&mesher, &done].map(|meshed| {
            let template = &meshed.document.templates[0];
            let lengths = before.regions.iter().map(|r| (r.id, length)).collect();
            mean_edge(&lengths, &template.vertices, &template.tets).unwrap()
        });
        let counts = [&mesher, &done].map(|meshed| meshed.document.templates[0].tets.len());
        assert!(means[0] < means[1] && means[1] < 1.1, "{order}: {means:?}");
        assert!(counts[0] > counts[1], "{order}: {counts:?}");
    }
}

/// The surface with the lengths asked for is the same surface: regions keep their volumes, walls and axis their points, and what other
/// templates share is as it was.
#[test]
fn a_surface_gets_the_lengths_asked_for() {
    let length = 0.2;
    for (before, index) in [
        (prism(3), 0),
        (prism(16), 0),
        (coated_ring(8, 0.15), 0),
        (with_hub(6), 0),
        (with_hub(6), 1),
    ] {
        let piece = Piece::of(&before, index);
        let sizes = Sizes::of_regions(&before);
        let plc = Plc::new(piece, &sizes, Description::PLAIN).unwrap();
        let lengths = before.regions.iter().map(|r| (r.id, length)).collect();
        let made = divided(piece, &plc, &lengths, Shared::Stay).unwrap();
        let (old, new) = (piece.template, &made.template);
        assert!(new.triangles.len() > old.triangles.len());
        let mut after = before.clone();
        after.templates[index] = new.clone();
        assert_eq!(validate(&after), []);
        for region in &before.regions {
            let [was, is] = [old, new].map(|t| volume_of_region(&t.vertices, t.faces(), region.id));
            assert!((was - is).abs() <= 1e-12 * was.abs(), "{was} {is}");
        }
        assert_eq!(new.vertices[..old.vertices.len()], old.vertices[..]);
        let normal = |t: &Template, triangle: usize| {
            let [a, b, c] = corners_of(t, triangle);
            (b - a).cross(c - a).normalize()
        };
        for (t, &parent) in made.parents.iter().enumerate() {
            let like = |t: &tmesh::Triangle| (t.marker, t.front, t.back);
            let parent = parent as usize;
            assert_eq!(like(&new.triangles[t]), like(&old.triangles[parent]));
            assert!(normal(new, t).dot(normal(old, parent)) > 1.0 - 1e-12);
        }
        let shared: Vec<usize> = (0..old.triangles.len())
            .filter(|&t| plc.faces.of_triangle[t] != NO_FACE)
            .filter(|&t| !plc.faces.is_glued_to_itself(plc.faces.of_triangle[t]))
            .collect();
        for &t in &shared {
            assert_eq!(new.triangles[t], old.triangles[t]);
        }
        let is_shared = |edge: [u32; 2]| {
            let has = |&t: &usize| {
                let corners = old.triangles[t].vertices;
                edge.iter().all(|v| corners.contains(v))
            };
            shared.iter().any(has)
        };
        for (t, triangle) in new.triangles.iter().enumerate() {
            let corners = corners_of(new, t);
            for i in 0..3 {
                let j = (i + 1) % 3;
                let edge = [i, j].map(|i| triangle.vertices[i]);
                // Between two edges of 4/3 that stay whole.
                let is_long = corners[i].distance(corners[j]) > 1.89 * length;
                assert!(!is_long || is_shared(edge), "{t}: {corners:?}");
            }
        }
        for (v, p) in new.vertices.iter().enumerate() {
            let on_axis = !old.axis.is_empty() && p.x == 0.0 && p.y == 0.0;
            assert_eq!(new.axis.contains(&(v as u32)), on_axis, "{p}");
            for gluing in &new.gluings {
                let plane = gluing.mirror_plane(index);
                let is_near = plane.is_some_and(|plane| plane.distance(*p).abs() <= 1e-15);
                let is_on = gluing.vertices_here().any(|on| on as usize == v);
                assert!(plane.is_none() || is_near == is_on, "{p} {}", gluing.name);
            }
        }
    }
}

fn corners_of(template: &Template, triangle: usize) -> [DVec3; 3] {
    let corners = template.triangles[triangle].vertices;
    corners.map(|v| template.vertices[v as usize])
}

#[test]
fn faces_between_templates_are_refined_alike() {
    let before = with_hub(6);
    // With several threads, the hub is meshed while the wedge is improved.
    let [one, four] = [1, 4].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let meshed = || mesh(before.clone(), &sized(1e-4)).unwrap();
        pool.build().unwrap().install(meshed)
    });
    assert_eq!(one.templates, four.templates);
    for done in [one, four] {
        let hub = &done.templates[0].gluings[2];
        assert!(hub.triangle_pairs.len() > 8);
        assert!(tmesh::validate(&done).is_empty());
    }
}

#[test]
fn any_scale_gives_the_same_mesh() {
    let base = mesh(coated_ring(16, 5e-2), &sized(1e-3)).unwrap();
    // Powers of two change no bit of the mantissas.
    for exponent in [-20, 20] {
        let scale = f64::from(exponent).exp2();
        let mut document = coated_ring(16, 5e-2);
        document.templates[0]
            .vertices
            .iter_mut()
            .for_each(|p| *p *= scale);
        let done = mesh(document, &sized(1e-3 * scale.powi(3))).unwrap();
        assert_eq!(done.templates[0].tets, base.templates[0].tets);
        assert_eq!(done.templates[0].triangles, base.templates[0].triangles);
    }
    for scale in [1e-6, 1e6] {
        let mut document = ratchet(5);
        for p in &mut document.templates[0].vertices {
            *p *= scale;
        }
        // Scaling rounds: put the high face back onto the image of the low one.
        let seam = document.templates[0].gluings[0].clone();
        for [high, low] in seam.vertex_pairs {
            document.templates[0].vertices[high as usize] = seam
                .step
                .apply(document.templates[0].vertices[low as usize]);
        }
        mesh(document, &sized(1e-3 * scale * scale * scale)).unwrap();
    }
}

#[test]
fn meshing_again_starts_from_the_surface() {
    let once = mesh(prism(4), &sized(1e-2)).unwrap();
    let mut again = once.clone();
    again.templates[0].vertices.push(DVec3::new(9.0, 9.0, 9.0));
    let done = filled(again, &sized(1e-2)).unwrap().document;
    assert_eq!(validate(&done), []);
    assert!(!done.templates[0].vertices.contains(&DVec3::splat(9.0)));
}

#[test]
fn a_plain_tetrahedralization_adds_little() {
    let plain = Wishes {
        quality: Some(false),
        ..Wishes::default()
    };
    let done = mesh(coated_ring(16, 5e-3), &plain).unwrap();
    assert!(done.templates[0].tets.len() < 100);
}

#[test]
fn open_surfaces_are_refused() {
    let mut document = coated_ring(6, 0.1);
    let removed = document.templates[0]
        .triangles
        .iter()
        .position(|t| t.marker == LEVEL)
        .unwrap();
    document.templates[0].triangles.remove(removed);
    document.templates[0].gluings.clear();
    let error = filled(document, &sized(0.01)).err().unwrap();
    assert!(matches!(error, Error::Open { edges: 2..=3, .. }), "{error}");
    assert!(matches!(failure(&error), Failure::Input(_)));
}

#[test]
fn inconsistent_regions_are_refused() {
    let mut document = coated_ring(6, 0.1);
    let t = &mut document.templates[0].triangles[3];
    for side in [&mut t.front, &mut t.back] {
        if *side == 4 {
            *side = 9;
        }
    }
    let error = filled(document, &sized(0.01)).err().unwrap();
    assert!(matches!(error, Error::MixedCell { .. }), "{error}");

    let mut document = prism(6);
    for t in &mut document.templates[0].triangles {
        std::mem::swap(&mut t.front, &mut t.back);
    }
    let error = filled(document, &sized(0.01)).err().unwrap();
    assert!(matches!(error, Error::Unbounded { .. }), "{error}");

    let mut document = prism(6);
    document.templates[0].triangles.clear();
    document.templates[0].gluings.clear();
    let error = filled(document, &sized(0.01)).err().unwrap();
    assert!(matches!(error, Error::NoSurface { .. }), "{error}");
}

#[test]
fn intersections_are_reported_with_their_place() {
    let mut document = prism(4);
    let mut other = document.templates[0].clone();
    let template = &mut document.templates[0];
    let base = template.vertices.len() as u32;
    for p in &other.vertices {
        template.vertices.push(*p * 0.5 + DVec3::new(0.6, 0.2, 0.1));
    }
    for t in &mut other.triangles {
        t.vertices = t.vertices.map(|v| v + base);
    }
    template.triangles.append(&mut other.triangles);
    let error = filled(document, &sized(0.01)).err().unwrap();
    let text = error.to_string();
    assert!(matches!(error, Error::Mesher { .. }), "{text}");
    assert!(
        text.contains("intersect") && text.contains("near ("),
        "{text}"
    );
    assert!(matches!(failure(&error), Failure::Impossible(_)));
}

#[test]
fn hopeless_requests_end() {
    let hasty = Wishes {
        timeout: Some(0.2),
        ..sized(1e-8)
    };
    let error = mesh(prism(4), &hasty).unwrap_err();
    let text = error.to_string();
    assert!(
        text.contains("0.2 s") && text.contains("--timeout"),
        "{text}"
    );
    let error = mesh(prism(4), &sized(1e-30)).unwrap_err();
    assert!(matches!(error, Error::TooMany { .. }), "{error}");
}

#[test]
fn a_time_limit_ends_improvement_with_a_mesh() {
    let document = coated_ring(7, 5e-3);
    described(&document, Description::PLAIN, |climb, answer| {
        let late = Climb {
            deadline: Deadline::start(Some(Duration::from_nanos(1))),
            ..*climb
        };
        let (done, _) = done::<()>((&late, None), (answer, Leaves::Mendable), None).unwrap();
        let told = done.advice.unwrap();
        assert!(
            told.contains("--timeout") && told.contains("remain"),
            "{told}"
        );
        let mut made = document.clone();
        made.templates[0] = done.filled.template;
        check(&document, &made);
    });
}

#[test]
fn switches_that_change_the_contract_are_errors() {
    for bad in ["o2", "h", "B"] {
        let params = Params {
            switches: bad.to_owned(),
            ..Params::new(&sized(0.1))
        };
        let done = tetrahedralize(prism(4), &params, Log::new(&|_| ()));
        assert!(done.is_err(), "{bad}");
    }
}

/// Meshes every template of a document in one attempt, its surface described like this.
fn described(document: &Document, description: Description, take: impl Fn(&Climb<'_>, Answer)) {
    let params = Params::new(&sized(1e-3));
    let mut document = document.clone();
    document.wishes = sized(1e-3);
    let document = &document;
    let sizes = Sizes::of_regions(document);
    let climb = Climb {
        piece: Piece::of(document, 0),
        params: &params,
        sizes: &sizes,
        preserve: true,
        rungs: &[],
        deadline: Deadline::start(params.timeout),
        mesher: &TetGen,
        log: Log::new(&|_| ()),
    };
    let attempt = Attempt {
        description,
        ..Attempt::new(Asks::AsWished)
    };
    let taken = climb.climb(attempt, |answer| {
        take(&climb, answer);
        Ok(())
    });
    taken.unwrap();
}

#[test]
fn equivalent_descriptions_give_equivalent_meshes() {
    let changes = LADDER.iter().map(|rung| rung.change);
    let descriptions = changes.filter_map(|change| match change {
        Change::Describe(description) => Some(description),
        _ => None,
    });
    let descriptions: Vec<Description> = std::iter::once(Description::PLAIN)
        .chain(descriptions)
        .collect();
    // One of them answers two endings.
    assert_eq!(descriptions.len(), 9);
    for document in [coated_ring(7, 5e-3), ratchet(7)] {
        for &description in &descriptions {
            described(&document, description, |climb, answer| {
                let is_moved = description.flat || description.stir.is_some();
                assert_eq!(answer.plc.shift > 0.0, is_moved);
                let (mut filled, origin) = fill(climb, &answer, Leaves::Mendable).unwrap();
                finish((climb, None), &answer.plc, &mut filled, origin).unwrap();
                let mut done = document.clone();
                done.templates[0] = filled.template;
                check(&document, &done);
            });
        }
    }
}
