//! Every kind of group, promised and kept or broken.

use super::{broken, report, sound};
use bodies::meshes::{assembled, sector};
use glam::DVec3;
use tmesh::{Document, Group, Isometry, Kind, Outside};

fn group(symbol: &str) -> Group {
    symbol.parse().unwrap()
}

/// Groups of all kinds whose sectors open by less than half a turn.
fn groups() -> Vec<Group> {
    let of_three = Kind::ALL.map(|kind| Group::new(kind, 3));
    let others = ["C2v", "S4", "D2", "D2d", "D2h", "C4", "C5h", "D1d"].map(group);
    of_three.into_iter().chain(others).collect()
}

/// Moves the tip of a tooth and its images under a subgroup a little, along with these.
fn move_teeth(whole: &mut Document, subgroup: Group) {
    let frame = sector(subgroup).frame;
    let vertices = &mut whole.templates[0].vertices;
    let canonical = |p: &DVec3| frame.to_canonical(*p);
    let reach = |p: &DVec3| canonical(p).truncate().length();
    // Another tooth than the sector's own would do as well.
    let tip = vertices.iter().map(canonical).enumerate();
    let (first, tip) = tip
        .max_by(|a, b| reach_of(a.1).total_cmp(&reach_of(b.1)))
        .unwrap();
    assert!(reach(&vertices[first]) > 2.0);
    for g in subgroup.elements() {
        let at = frame.to_world(g.apply(tip));
        let moved = frame.to_world(g.apply(tip * DVec3::new(1.01, 1.02, 1.03)));
        let nearest = vertices
            .iter_mut()
            .min_by(|a, b| a.distance(at).total_cmp(&b.distance(at)));
        *nearest.unwrap() = moved;
    }
}

fn reach_of(p: DVec3) -> f64 {
    p.truncate().length()
}

#[test]
fn every_kind_of_group_is_proved_of_instances_and_of_their_assembly() {
    for group in groups() {
        let instanced = sector(group);
        assert_eq!(tmesh::validate(&instanced), [], "{group}");
        let whole = assembled(&instanced);
        let (a, b) = (sound(&instanced), sound(&whole));
        assert_eq!(a.summary.vertices, b.summary.vertices, "{group}");
        assert_eq!(a.summary.tetrahedra, b.summary.tetrahedra, "{group}");
        for r in [&a, &b] {
            assert_eq!(r.checks.connectivity_symmetric, Some(true), "{group}");
            assert!(r.checks.symmetry_residual.unwrap() < 1e-15, "{group}");
            let symmetry = r.summary.symmetry.unwrap();
            assert_eq!(symmetry.group, group);
            let json = serde_json::to_value(symmetry).unwrap();
            assert_eq!(json["group"], group.symbol());
            assert_eq!(json["order"], group.order);
            assert_eq!(json["mirror"], group.has_vertical_mirrors());
            assert_eq!(json["horizontal_mirror"], group.has_horizontal_mirror());
        }
        let text = crate::text(&b, true);
        let words = format!("promises a symmetry of {group}\n");
        assert!(text.contains(&words), "{text}");
    }
}

#[test]
fn a_vertex_moved_under_a_subgroup_breaks_the_other_generators_only() {
    for (whole, kept, name) in [
        ("D3", "C3", "the half turn across the axis"),
        ("S4", "C2", "the rotary reflection of order 4"),
        ("S6", "C3", "the rotary reflection of order 6"),
        ("D2d", "C2v", "the rotary reflection of order 4"),
        ("D2d", "S4", "the mirror"),
        ("D2d", "C2", "the mirror"),
        ("C3h", "C3", "the horizontal mirror"),
        ("D3h", "C3v", "the horizontal mirror"),
        ("D3h", "C3h", "the mirror"),
        ("C3v", "C3", "the mirror"),
        ("D3h", "D1h", "the rotation of order 3"),
    ] {
        let (whole, kept) = (group(whole), group(kept));
        let mut mesh = assembled(&sector(whole));
        move_teeth(&mut mesh, kept);
        broken(&mesh, "symmetry", &format!("under {name} "));
        mesh.promise.as_mut().unwrap().group = kept;
        sound(&mesh);
    }
}

#[test]
fn a_region_that_only_rotations_keep_breaks_the_half_turn() {
    for (whole, kept) in [("D3", "C3"), ("S4", "C2"), ("D2d", "S4")] {
        let (whole, kept) = (group(whole), group(kept));
        let instanced = sector(whole);
        let mut mesh = assembled(&instanced);
        // The teeth of every second copy become part of the prism.
        let count = instanced.templates[0].tets.len();
        for (instance, tets) in instanced
            .instances
            .iter()
            .zip(mesh.templates[0].tets.chunks_mut(count))
        {
            if !kept.contains(instance.isometry) {
                tets.iter_mut().for_each(|t| t.region = 1);
            }
        }
        mesh.templates[0].triangles = bodies::meshes::skin(&mesh.templates[0].tets);
        let found = broken(&mesh, "symmetry", "maps tetrahedron");
        assert_eq!(found.checks.connectivity_symmetric, Some(false));
        mesh.promise.as_mut().unwrap().group = kept;
        sound(&mesh);
    }
}

#[test]
fn instances_of_a_subgroup_fall_short_of_the_promise() {
    for (whole, kept) in [("D3", "C3"), ("S4", "C2"), ("D2d", "C2v"), ("D2d", "S4")] {
        let (whole, kept) = (group(whole), group(kept));
        let mut instanced = sector(whole);
        instanced.instances.retain(|i| kept.contains(i.isometry));
        let text = format!("they have the symmetry {kept}, the document promises {whole}");
        let found = broken(&instanced, "symmetry", &text);
        assert_eq!(found.checks.connectivity_symmetric, Some(false));
    }
}

#[test]
fn half_turn_walls_and_seams_that_turn_over_list_everything() {
    for symbol in ["D3", "S4", "D2d"] {
        let sound = sector(group(symbol));
        let wall = sound.templates[0].gluings.len() - 1;
        let mut instanced = sound.clone();
        instanced.templates[0].gluings[wall]
            .triangle_pairs
            .remove(0);
        broken(&instanced, "conforming", "on wall");
        let mut instanced = sound;
        let pairs = &mut instanced.templates[0].gluings[wall].vertex_pairs;
        let last = pairs.iter().rposition(|p| p[0] != p[1]).unwrap();
        pairs.remove(last);
        let found = report(&instanced);
        assert!(!found.checks.passed, "{symbol}");
    }
}

#[test]
fn what_is_promised_outside_may_turn_the_axis_over() {
    for (whole, inner, beyond) in [
        ("D4", "D2", "D4d"),
        ("S8", "C2", "D8"),
        ("D4d", "C4", "D8d"),
    ] {
        let mut mesh = assembled(&sector(group(whole)));
        let promise = mesh.promise.as_mut().unwrap();
        promise.group = group(inner);
        promise.outside = Some(Outside {
            group: group(whole),
            radius: 1.5,
        });
        sound(&mesh);
        // Nothing but the axis lies within the radius.
        move_teeth(&mut mesh, group(inner));
        broken(&mesh, "symmetry", "outside of the radius 1.5");
        let promise = mesh.promise.as_mut().unwrap();
        promise.outside = Some(Outside {
            group: group(beyond),
            radius: 1.5,
        });
        broken(&mesh, "symmetry", "outside of the radius 1.5");
    }
}

#[test]
fn a_reflection_is_no_half_turn() {
    // Both turn z over, and both keep the prism; only one keeps the teeth.
    let mut mesh = assembled(&sector(group("D3")));
    mesh.promise.as_mut().unwrap().group = group("C3h");
    broken(&mesh, "symmetry", "under the horizontal mirror");
    let turned = Isometry::half_turn(0, 1);
    assert!(group("D3").contains(turned) && !group("C3h").contains(turned));
}
