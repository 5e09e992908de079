//! Sizes that are not the same everywhere: of regions, and across walls.

use bodies::{Body, Coating, Prism, Ratchet, Tessellation};
use std::collections::BTreeMap;
use support::{EXACT_STL, encode, read, run};
use tmesh::{Document, Template};

/// A ring of two materials, neither of them thin.
fn ring() -> Body {
    let ring = Coating {
        order: 8,
        radius: 1.0,
        bore: 0.3,
        thickness: 0.3,
        height: 0.5,
        tessellation: Tessellation::Symmetric,
    };
    ring.build()
}

/// Mean length of the edges of each region's elements, by the region's name; elements count their six edges.
fn mean_edges(document: &Document) -> BTreeMap<String, f64> {
    let mut sums: BTreeMap<u32, [f64; 2]> = BTreeMap::new();
    for template in &document.templates {
        for tet in &template.tets {
            let sum = sums.entry(tet.region).or_default();
            for i in 0..4 {
                for j in 0..i {
                    let [p, q] = [i, j].map(|k| template.vertices[tet.vertices[k] as usize]);
                    sum[0] += p.distance(q);
                    sum[1] += 1.0;
                }
            }
        }
    }
    let name = |id: u32| {
        let region = document.regions.iter().find(|r| r.id == id);
        region.expect("a region").name.clone()
    };
    let means = sums.into_iter();
    means.map(|(id, [sum, n])| (name(id), sum / n)).collect()
}

/// What a region is told goes before what all are told, whoever is told, and its neighbour stays coarse.
#[test]
fn a_region_has_a_length_of_its_own() {
    let found = run("symdetect", &["-q"], &encode(&ring(), EXACT_STL)).success();
    let names: Vec<String> = read(&found)
        .regions
        .iter()
        .map(|r| r.name.clone())
        .collect();
    for domain in ["mirror", "rotation"] {
        for fine in &names {
            let own = format!("{fine}:edge-length=0.04");
            let asked = ["-q", "--edge-length", "0.15", "--region", &own];
            let cut = run(
                "wedgecut",
                &[&asked[..], &["--domain", domain]].concat(),
                &found,
            );
            let filled = run("tetwedge", &["-q"], &cut.success()).success();
            run("meshqual", &["-q", "--check"], &filled).success();
            for (name, mean) in mean_edges(&read(&filled)) {
                let what = format!("{domain}, {fine} fine, {name}: {mean}");
                match name == *fine {
                    true => assert!((mean / 0.04 - 1.0).abs() < 0.15, "{what}"),
                    false => assert!(mean > 0.05, "{what}"),
                }
            }
            // A later tool may be told otherwise, of volumes as well.
            let volume = format!("{fine}:max-volume=0.001");
            let coarser = run(
                "tetwedge",
                &["-q", "--region", &volume],
                &cut_of(&filled, &found),
            );
            let coarser = mean_edges(&read(&coarser.success()));
            assert!(coarser[fine] > 0.08, "{domain}: {coarser:?}");
        }
    }
}

/// A wedge cut as a filled one was asked to be.
fn cut_of(filled: &[u8], found: &[u8]) -> Vec<u8> {
    let mut document = read(found);
    let filled = read(filled);
    document.wishes = filled.wishes;
    document.regions = filled.regions;
    document.wishes.keep_surface = None;
    let mut bytes = Vec::new();
    tmesh::write(&document, &mut bytes).expect("memory takes it");
    run("wedgecut", &["-q"], &bytes).success()
}

/// The fewest edges on a way from the lowest points of a template to the highest: the least, and the mean over the highest.
fn edges_across(template: &Template) -> [f64; 2] {
    let heights = || template.vertices.iter().map(|p| p.z);
    let [low, high] = [
        heights().fold(f64::MAX, f64::min),
        heights().fold(f64::MIN, f64::max),
    ];
    // The mesher's points are off a plane by rounding.
    let off = 1e-9 * (high - low);
    let mut at = vec![Vec::new(); template.vertices.len()];
    for tet in &template.tets {
        for a in tet.vertices {
            at[a as usize].extend(tet.vertices);
        }
    }
    let mut front: Vec<u32> = (0..at.len() as u32)
        .filter(|&v| template.vertices[v as usize].z <= low + off)
        .collect();
    let mut steps: Vec<Option<u32>> = vec![None; at.len()];
    front.iter().for_each(|&v| steps[v as usize] = Some(0));
    for step in 1.. {
        let mut next = Vec::new();
        for &w in front.iter().flat_map(|&v| &at[v as usize]) {
            if steps[w as usize].is_none() {
                steps[w as usize] = Some(step);
                next.push(w);
            }
        }
        if next.is_empty() {
            break;
        }
        front = next;
    }
    let all = template.vertices.iter().zip(&steps);
    let top: Vec<f64> = all
        .filter(|(p, _)| p.z >= high - off)
        .map(|(_, steps)| f64::from(steps.expect("all hangs together")))
        .collect();
    let least = top.iter().copied().fold(f64::MAX, f64::min);
    [least, top.iter().sum::<f64>() / top.len() as f64]
}

/// A plate of a tenth of its radius gets as many elements across as are asked for, between mirror planes and with seams, with a hub
/// and without, and few without being asked.
#[test]
fn walls_get_elements_across() {
    let plate = Prism {
        order: 8,
        radius: 1.0,
        height: 0.1,
        bore: 0.4,
        tessellation: Tessellation::Symmetric,
    };
    let ratchet = Ratchet {
        height: 0.1,
        ..Ratchet::default()
    };
    let disc = Prism {
        bore: 0.0,
        order: 32,
        ..plate.clone()
    };
    let level = ["--horizontal-mirror", "off"];
    for (name, body) in [
        ("plate", plate.build()),
        ("ratchet", ratchet.build()),
        ("disc", disc.build()),
    ] {
        let found = run("symdetect", &["-q"], &encode(&body, EXACT_STL)).success();
        let mut before = 0;
        for layers in [1_u32, 3, 6] {
            let asked = ["-q", "--layers-across", &layers.to_string()];
            let cut = run("wedgecut", &[&asked[..], &level].concat(), &found).success();
            let filled = run("tetwedge", &["-q"], &cut).success();
            let whole = run("rotassemble", &["-q", "--to", "tmesh"], &filled).success();
            run("meshqual", &["-q", "--check"], &whole).success();
            let filled = read(&filled);
            for [least, mean] in filled.templates.iter().map(edges_across) {
                let what = format!("{name}: {least}, {mean} of {layers}");
                assert!(3.0 * least >= 2.0 * f64::from(layers), "{what}");
                assert!(mean >= 0.97 * f64::from(layers), "{what}");
            }
            let mean = mean_edges(&filled).into_values().fold(0.0, f64::max);
            assert!(
                mean < 1.2 * 0.1 / f64::from(layers),
                "{name}, {layers}: {mean}"
            );
            let count: usize = filled.templates.iter().map(|t| t.tets.len()).sum();
            assert!(count > before, "{name}, {layers}: {count} {before}");
            before = count;
        }
    }
}

/// The number is inherited and may be told otherwise; what cannot be is refused in a sentence.
#[test]
fn elements_across_walls_are_a_wish_like_others() {
    let found = run("symdetect", &["-q"], &encode(&ring(), EXACT_STL)).success();
    let cut = run("wedgecut", &["-q", "--layers-across", "2"], &found).success();
    assert_eq!(read(&cut).wishes.layers_across, Some(2));
    let count = |asked: &[&str]| {
        let filled = run("tetwedge", &[&["-q"], asked].concat(), &cut).success();
        read(&filled).templates[0].tets.len()
    };
    let inherited = count(&[]);
    assert_eq!(inherited, count(&["--threads", "1"]));
    assert!(count(&["--layers-across", "4"]) > 2 * inherited);
    run("wedgecut", &["--layers-across", "0"], &found).fails(2, &["--layers-across"]);
    let film = Coating {
        order: 8,
        radius: 1.0,
        bore: 0.3,
        thickness: 1e-4,
        height: 1.0,
        tessellation: Tessellation::Symmetric,
    };
    let found = run("symdetect", &["-q"], &encode(&film.build(), EXACT_STL)).success();
    let cut = run("wedgecut", &["-q", "--layers-across", "4"], &found).success();
    run("tetwedge", &["-q"], &cut).fails(
        1,
        &[
            "4 elements across",
            "the thinnest has 1.000e-4",
            "--layers-across",
        ],
    );
}
