//! Wedges of made bodies: volume, walls, seams, regions.

use crate::{CutError, Domain, Params, Report};
use geom::measure::area_of_region;
use glam::{DMat3, DVec3};
use tmesh::{
    Axis, Document, Group, Kind, Marker, OUTSIDE, Region, Source, Symmetry, Template, Triangle,
    validate,
};

const DEFAULT: Params = Params {
    hub: crate::Hub::None,
    level: false,
    domain: Domain::Auto,
    order: None,
    start_angle: None,
    seam: crate::Seam::Plane,
    snap: None,
    clean: 1e-6,
    threads: 1,
};

/// Cuts at the order found unless the parameters have another.
fn cut(document: Document, params: &Params) -> Result<(Document, Report), CutError> {
    let found = document.symmetry.as_ref().map(|s| s.group.order);
    let params = Params {
        order: params.order.or(found),
        ..params.clone()
    };
    crate::cut(document, &params)
}

/// Nested rings of points around the axis, extruded and twisted; region k + 1 lies inside ring k.
/// Caps are fans or strips whose diagonals do not share the symmetry.
struct Body {
    rings: Vec<Vec<[f64; 2]>>,
    bore: bool,
    heights: Vec<f64>,
    twist: f64,
    /// Divide the sides' quadrilaterals differently from sector to sector.
    mixed_diagonals: bool,
}

impl Body {
    fn regular(n: usize, radii: &[f64]) -> Self {
        let ring = |r: &f64| {
            (0..n)
                .map(|k| {
                    let a = std::f64::consts::TAU * k as f64 / n as f64;
                    [r * a.cos(), r * a.sin()]
                })
                .collect()
        };
        Self {
            rings: radii.iter().map(ring).collect(),
            bore: false,
            heights: vec![0.0, 1.0],
            twist: 0.0,
            mixed_diagonals: false,
        }
    }

    /// Saw teeth: chiral.
    fn ratchet(n: usize, bore: bool) -> Self {
        let mut body = Self::regular(2 * n, &[1.0]);
        for (k, p) in body.rings[0].iter_mut().enumerate() {
            let a = std::f64::consts::TAU / n as f64 * ((k / 2) as f64 + 0.9 * (k % 2) as f64);
            let r = if k % 2 == 0 { 0.7 } else { 1.0 };
            *p = [r * a.cos(), r * a.sin()];
        }
        if bore {
            let inner = |p: &[f64; 2]| p.map(|x| 0.3 * x / p[0].hypot(p[1]));
            body.rings.push(body.rings[0].iter().map(inner).collect());
            body.bore = true;
        }
        body
    }

    fn document(&self, group: (u32, bool), place: Option<u64>, scale: f64) -> Document {
        let (n, layers, rings) = (self.rings[0].len(), self.heights.len(), self.rings.len());
        let mut t = Template::default();
        for (level, &z) in self.heights.iter().enumerate() {
            let a = self.twist * level as f64 / (layers - 1) as f64;
            for [x, y] in self.rings.iter().flatten() {
                t.vertices.push(DVec3::new(
                    x * a.cos() - y * a.sin(),
                    x * a.sin() + y * a.cos(),
                    z,
                ));
            }
        }
        // Fans of the innermost ring start off the axis, so that they have no symmetry.
        let hubs = [0, layers - 1].map(|level| {
            t.vertices
                .push(DVec3::new(0.01, 0.004, self.heights[level]));
            t.vertices.len() as u32 - 1
        });
        let id =
            |level: usize, ring: usize, k: usize| (level * rings * n + ring * n + k % n) as u32;
        let region = |ring: usize| {
            if ring == rings || (self.bore && ring == rings - 1) {
                OUTSIDE
            } else {
                ring as u32 + 1
            }
        };
        let mut put = |a, b, c, front, back| {
            t.triangles.push(Triangle {
                vertices: [a, b, c],
                marker: 1,
                front,
                back,
            });
        };
        for ring in 0..rings {
            let outer = if ring == 0 { OUTSIDE } else { region(ring - 1) };
            for level in 0..layers - 1 {
                for k in 0..n {
                    let [a, b] = [id(level, ring, k), id(level, ring, k + 1)];
                    let [c, d] = [id(level + 1, ring, k), id(level + 1, ring, k + 1)];
                    if self.mixed_diagonals && (k * 5 + level) % 3 == 0 {
                        put(a, b, c, outer, region(ring));
                        put(b, d, c, outer, region(ring));
                    } else {
                        put(a, b, d, outer, region(ring));
                        put(a, d, c, outer, region(ring));
                    }
                }
            }
            if region(ring) == OUTSIDE {
                continue;
            }
            for (level, up) in [(0, false), (layers - 1, true)] {
                let mut cap = |a: u32, b: u32, c: u32| {
                    let [b, c] = if up { [b, c] } else { [c, b] };
                    put(a, b, c, OUTSIDE, region(ring));
                };
                for k in 0..n {
                    if ring + 1 < rings {
                        let [a, b] = [id(level, ring, k), id(level, ring, k + 1)];
                        let [c, d] = [id(level, ring + 1, k), id(level, ring + 1, k + 1)];
                        // One diagonal or the other, without symmetry.
                        if (k * 7 + level) % 3 == 0 {
                            cap(a, b, d);
                            cap(a, d, c);
                        } else {
                            cap(a, b, c);
                            cap(b, d, c);
                        }
                    } else {
                        cap(
                            hubs[usize::from(up)],
                            id(level, ring, k),
                            id(level, ring, k + 1),
                        );
                    }
                }
            }
        }
        let regions = (0..rings)
            .filter(|&r| region(r) != OUTSIDE)
            .map(|r| Region {
                id: r as u32 + 1,
                name: format!("r{r}"),
                size: None,
                volume: None,
            })
            .collect();
        let (rotation, shift) = place.map_or((DMat3::IDENTITY, DVec3::ZERO), placement);
        for p in &mut t.vertices {
            *p = (rotation * *p + shift) * scale;
        }
        let mut document = Document::single(t);
        document.regions = regions;
        document.markers = vec![Marker {
            id: 1,
            name: "skin".to_owned(),
            area: None,
        }];
        document.source = Some(Source {
            sector_of: None,
            format: "stl".to_owned(),
            triangles: document.templates[0].triangles.len() as u64,
            volume: 0.0,
            boundary_area: 0.0,
            precision: 1e-15 * scale,
        });
        document.symmetry = Some(Symmetry {
            group: Group::new(if group.1 { Kind::Cv } else { Kind::C }, group.0),
            axis: Axis {
                point: (shift * scale).to_array(),
                direction: rotation.z_axis.to_array(),
            },
            reference: rotation.x_axis.to_array(),
            residual: 1e-14,
            tolerance: 1e-3,
            axisymmetric: false,
            radius: scale,
            regions: Vec::new(),
        });
        document
    }
}

/// A rotation and shift that depend on a seed.
fn placement(seed: u64) -> (DMat3, DVec3) {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    let axis = DVec3::new(next(), next(), next() + 0.01).normalize();
    let turn = DMat3::from_axis_angle(axis, 6.0 * next());
    (turn, DVec3::new(next(), next(), next()))
}

fn volume(template: &Template, region: u32) -> f64 {
    geom::measure::volume_of_region(&template.vertices, template.faces(), region)
}

fn check(body: &Document, params: &Params, copies: usize) -> Document {
    check_to(body, params, copies, 1e-9)
}

fn check_to(body: &Document, params: &Params, copies: usize, accuracy: f64) -> Document {
    let (wedge, _) = cut(body.clone(), params).unwrap();
    assert_eq!(validate(&wedge), []);
    assert_eq!(wedge.instances.len(), copies);
    for region in &body.regions {
        let whole = volume(&body.templates[0], region.id);
        let part = volume(&wedge.templates[0], region.id) * copies as f64;
        assert!(
            (part / whole - 1.0).abs() < accuracy,
            "region {}: {part} of {whole}",
            region.id
        );
    }
    let extent = wedge.templates[0]
        .vertices
        .iter()
        .map(|p| p.x.hypot(p.y))
        .fold(0.0, f64::max);
    for p in &wedge.templates[0].vertices {
        let inside = copies == 1 || p.y >= -1e-12 * extent;
        assert!(inside, "{p} is outside of the wedge");
    }
    wedge
}

#[test]
fn mirror_wedges_of_prisms() {
    for n in [3, 4, 5, 8, 16, 33, 128] {
        for (place, scale) in [(None, 1.0), (Some(7), 1.0), (Some(8), 1e-6), (Some(9), 1e6)] {
            for radii in [&[1.0][..], &[1.0, 0.5, 0.495]] {
                let body = Body::regular(n, radii).document((n as u32, true), place, scale);
                let wedge = check(&body, &DEFAULT, 2 * n);
                let t = &wedge.templates[0];
                assert_eq!(t.axis.len(), 2, "the axis enters and leaves");
                // Half a sector per layer and the core: nothing of the caps' diagonals is left.
                assert_eq!(t.vertices.len(), 2 + 4 * radii.len());
            }
        }
    }
}

#[test]
fn divisors_domains_and_bores() {
    let mut body = Body::regular(12, &[1.0, 0.4]);
    body.bore = true;
    let body = body.document((12, true), Some(3), 1.0);
    for order in [1, 2, 3, 4, 6, 12] {
        let params = Params {
            order: Some(order),
            ..DEFAULT
        };
        let wedge = check(&body, &params, 2 * order as usize);
        assert!(wedge.templates[0].axis.is_empty());
        let params = Params {
            domain: Domain::Rotation,
            ..params
        };
        if order > 1 {
            check(&body, &params, order as usize);
        }
    }
    let params = Params {
        order: Some(5),
        ..DEFAULT
    };
    assert!(matches!(
        cut(body, &params),
        Err(CutError::NotADivisor { asked: 5, .. })
    ));
}

#[test]
fn seams_of_chiral_bodies() {
    for n in [2, 3, 7, 12, 30] {
        for bore in [false, true] {
            for place in [None, Some(1), Some(5)] {
                let body = Body::ratchet(n, bore).document((n as u32, false), place, 1.0);
                let wedge = check(&body, &DEFAULT, n);
                let t = &wedge.templates[0];
                let [seam] = &t.gluings[..] else {
                    panic!("one seam")
                };
                assert!(seam.is_seam(0));
                assert!(!seam.triangle_pairs.is_empty());
                let fixed = seam.vertex_pairs.iter().filter(|p| p[0] == p[1]).count();
                assert_eq!(fixed, if bore { 0 } else { 2 });
                assert_eq!(t.axis.len(), fixed);
            }
        }
    }
    let params = Params {
        domain: Domain::Mirror,
        ..DEFAULT
    };
    let body = Body::ratchet(7, true).document((7, false), None, 1.0);
    assert!(matches!(cut(body, &params), Err(CutError::NoMirror(_))));
}

#[test]
fn twisted_bodies_and_start_angles() {
    let mut body = Body::ratchet(5, true);
    body.heights = (0..9).map(|k| f64::from(k) / 8.0).collect();
    body.twist = 0.7;
    let body = body.document((5, false), Some(11), 1.0);
    check(&body, &DEFAULT, 5);
    for degrees in [0.0_f64, 10.0, 33.3, -20.0] {
        let params = Params {
            start_angle: Some(degrees.to_radians()),
            ..DEFAULT
        };
        check(&body, &params, 5);
    }
}

#[test]
fn a_start_angle_close_by_edges_is_told() {
    let body = Body::regular(12, &[1.0]).document((12, false), None, 1.0);
    let warning = |degrees: f64| {
        let params = Params {
            start_angle: Some(degrees.to_radians()),
            order: Some(4),
            ..DEFAULT
        };
        cut(body.clone(), &params).unwrap().1.warning
    };
    // Edges along the axis are at multiples of 30 degrees.
    let told = warning(30.02).expect("a strip 3e-4 wide");
    assert!(
        told.contains("--start-angle 30.02 passes close by edges"),
        "{told}"
    );
    assert_eq!((warning(15.0), warning(40.0)), (None, None));
    // Through the edges is no worse a place than any.
    assert_eq!((warning(30.0), warning(-60.0)), (None, None));
    let useless = Params {
        start_angle: Some(30.0_f64.to_radians() + 1e-5),
        order: Some(4),
        ..DEFAULT
    };
    assert!(matches!(
        cut(body.clone(), &useless),
        Err(CutError::BadPlace { .. })
    ));
    assert_eq!(cut(body, &DEFAULT).unwrap().1.warning, None);
}

#[test]
fn wrong_documents_are_refused() {
    let body = Body::regular(6, &[1.0]).document((6, true), None, 1.0);
    let (wedge, _) = cut(body.clone(), &DEFAULT).unwrap();
    assert!(matches!(
        cut(wedge, &DEFAULT),
        Err(CutError::NotASurface(_))
    ));
    let mut without = body.clone();
    without.symmetry = None;
    assert!(matches!(cut(without, &DEFAULT), Err(CutError::NoSymmetry)));
    // Stated order 5 on a hexagon: the sections or the volume give it away.
    let mut wrong = body;
    let symmetry = wrong.symmetry.as_mut().unwrap();
    symmetry.group = Group::new(Kind::C, 5);
    assert!(cut(wrong, &DEFAULT).is_err());
}

/// As a binary STL would hold it.
fn single_precision(mut document: Document) -> Document {
    let t = &mut document.templates[0];
    let mut largest = 0.0_f64;
    for p in &mut t.vertices {
        *p = p.as_vec3().as_dvec3();
        largest = largest.max(p.abs().max_element());
    }
    let precision = largest * (-24.0_f64).exp2();
    document.source.as_mut().unwrap().precision = precision;
    let symmetry = document.symmetry.as_mut().unwrap();
    symmetry.residual = 4.0 * precision / symmetry.radius;
    document
}

#[test]
fn single_precision_bodies_anywhere() {
    for seed in 0..8 {
        for scale in [1.0, 1e-6, 1e6] {
            for n in [3_u32, 7, 16, 64] {
                let tsv = Body::regular(n as usize, &[1.0, 0.5, 0.495]);
                let body = single_precision(tsv.document((n, true), Some(seed), scale));
                let wedge = check_to(&body, &DEFAULT, 2 * n as usize, 1e-4);
                let t = &wedge.templates[0];
                assert_eq!(t.vertices.len(), 2 + 4 * 3);
                assert_eq!(distinct(t.vertices.iter().map(|p| p.z)), 2);
                let ratchet = Body::ratchet(n as usize, seed % 2 == 0);
                let body = single_precision(ratchet.document((n, false), Some(seed), scale));
                let wedge = check_to(&body, &DEFAULT, n as usize, 1e-4);
                assert_eq!(distinct(wedge.templates[0].vertices.iter().map(|p| p.z)), 2);
            }
        }
    }
}

fn distinct(values: impl Iterator<Item = f64>) -> usize {
    let mut bits: Vec<u64> = values.map(f64::to_bits).collect();
    bits.sort_unstable();
    bits.dedup();
    bits.len()
}

#[test]
fn sections_with_different_points_are_reconciled() {
    for n in [5_usize, 7, 12] {
        for bore in [false, true] {
            let mut body = Body::ratchet(n, bore);
            body.heights = (0..=60).map(|k| f64::from(k) / 60.0).collect();
            body.twist = 0.3;
            body.mixed_diagonals = true;
            let mut body = body.document((n as u32, false), Some(4), 1.0);
            body.symmetry.as_mut().unwrap().residual = 8e-4;
            let (wedge, report) = cut(body.clone(), &DEFAULT).unwrap();
            assert_eq!(validate(&wedge), []);
            assert!(
                report
                    .notes
                    .iter()
                    .any(|n| n.contains("that only one side had"))
            );
            let whole = volume(&body.templates[0], 1);
            let part = volume(&wedge.templates[0], 1) * n as f64;
            assert!((part / whole - 1.0).abs() < 2e-3, "{part} of {whole}");
            // Within a tolerance that the sections exceed, they are refused.
            body.symmetry.as_mut().unwrap().residual = 1e-9;
            let refused = cut(body, &DEFAULT).unwrap_err();
            assert!(matches!(refused, CutError::SectionsDiffer { .. }));
            assert!(refused.to_string().contains("--order 1"), "{refused}");
        }
    }
}

#[test]
fn a_body_without_symmetry_passes_whole() {
    let body = single_precision(Body::ratchet(5, true).document((1, false), Some(2), 1.0));
    let whole = check_to(&body, &DEFAULT, 1, 1e-4);
    assert!(whole.templates[0].gluings.is_empty());
    assert_eq!(
        whole.templates[0].triangles.len(),
        body.templates[0].triangles.len()
    );
}

#[test]
fn edges_too_short_to_mesh_are_collapsed() {
    // A ring 4e-6 inside the outer one: its layer goes when detail of 1e-5 is collapsed.
    let body = Body::regular(8, &[1.0, 1.0 - 4e-6, 0.5]).document((8, true), Some(6), 1.0);
    let kept = check(&body, &DEFAULT, 16);
    let coarse = Params {
        clean: 1e-5,
        ..DEFAULT
    };
    let (collapsed, report) = cut(body, &coarse).unwrap();
    assert_eq!(validate(&collapsed), []);
    assert_eq!(
        kept.templates[0].vertices.len(),
        collapsed.templates[0].vertices.len() + 4
    );
    assert!(
        report
            .notes
            .iter()
            .any(|n| n.contains("edges below 1.0e-5 collapsed: 4 points")),
        "{:?}",
        report.notes
    );
    // A region is gone with them, which is said, though the whole is as large.
    let told = report.differs.expect("what was taken out");
    assert!(told.contains("--clean took out"), "{told}");
    assert!(collapsed.wishes.moved.is_some());
}

/// Copies may differ from the body by as much as cutting moves things. That is said, and written down for who compares volumes.
#[test]
fn sectors_that_differ_are_told() {
    let bulged = |bulge: f64| {
        let mut body = Body::regular(8, &[1.0]).document((4, false), None, 1.0);
        let template = &mut body.templates[0];
        // The first side's lower triangle, with a vertex in its middle that is off it.
        let side = template.triangles[0];
        let [a, b, c] = side.vertices;
        let at = |v: u32| template.vertices[v as usize];
        let outwards = (at(b) - at(a)).cross(at(c) - at(a)).normalize();
        let middle = (at(a) + at(b) + at(c)) / 3.0 + outwards * bulge;
        let new = template.vertices.len() as u32;
        template.vertices.push(middle);
        template.triangles[0].vertices = [a, b, new];
        for vertices in [[b, c, new], [c, a, new]] {
            template.triangles.push(Triangle { vertices, ..side });
        }
        cut(body, &DEFAULT)
    };
    let (wedge, report) = bulged(0.0).unwrap();
    assert_eq!((wedge.wishes.moved, report.differs), (None, None));
    let (wedge, report) = bulged(1e-4).unwrap();
    let told = report.differs.expect("what they differ by");
    assert!(told.contains("copies differ from the body's"), "{told}");
    // The volume below the bulge is there four times, or not at all.
    let [volume, area] = [8.0_f64.sqrt(), 2.0 * 8.0_f64.sqrt() + 8.0 * 0.765];
    let below = 1e-4 * 0.5 * 0.765 / 3.0;
    let most = 3.0 * below / (4.0 * area);
    let moved = wedge.wishes.moved.expect("how far the surface is");
    assert!(moved > 0.1 * most && moved <= most, "{moved:e} {most:e}");
    assert!(3.0 * below / volume > geom::tolerance::VOLUME);
    assert_eq!(validate(&wedge), []);
    let error = bulged(1e-3).unwrap_err();
    assert!(matches!(error, CutError::VolumeDiffers { .. }), "{error}");
}

#[test]
fn sheets_without_thickness_are_no_boundary_any_more() {
    // A core, and a thin sheet around it.
    let mut body = Body::regular(8, &[1.0, 0.7, 0.7 - 4e-6, 0.5]).document((8, true), None, 1.0);
    for t in &mut body.templates[0].triangles {
        for side in [&mut t.front, &mut t.back] {
            *side = match *side {
                2 | 4 => 4,
                _ => OUTSIDE,
            };
        }
    }
    body.templates[0].triangles.retain(|t| t.front != t.back);
    body.regions.retain(|r| r.id == 4);
    let (vertices, faces) = (&body.templates[0].vertices, body.templates[0].faces());
    let whole = area_of_region(vertices, faces.clone(), OUTSIDE);
    let of_core = |v: &u32| vertices[*v as usize].truncate().length() < 0.6;
    let core = faces.filter(|(ids, _)| ids.iter().all(of_core));
    let core = area_of_region(vertices, core, OUTSIDE);
    assert!(core < 0.5 * whole, "{core}, {whole}");
    let source = Source {
        boundary_area: whole,
        ..body.source.clone().unwrap()
    };
    let coarse = Params {
        clean: 1e-5,
        ..DEFAULT
    };
    for (params, left) in [(&coarse, core), (&DEFAULT, whole)] {
        let body = Document {
            source: Some(source.clone()),
            ..body.clone()
        };
        let (closed, report) = cut(body, params).unwrap();
        let after = closed.source.unwrap().boundary_area;
        assert!((after - left).abs() < 1e-4, "{after}, {left}");
        let told = report
            .notes
            .iter()
            .any(|n| n.contains("of the boundary's area"));
        assert_eq!(told, left < whole, "{:?}", report.notes);
    }
}

#[test]
fn halves_must_have_the_names_of_both() {
    // Two triangles face to face, one above the plane and one below.
    let (origin, axis) = (DVec3::new(1.0, 2.0, 3.0), DVec3::Z);
    let level = |z: f64| [DVec3::X, DVec3::Y, DVec3::ZERO].map(|p| p + origin + axis * z);
    let body = |markers: [u32; 2], heights: [f64; 2]| Template {
        vertices: heights.into_iter().flat_map(level).collect(),
        triangles: [([0, 1, 2], markers[0]), ([3, 5, 4], markers[1])]
            .map(|(vertices, marker)| Triangle {
                vertices,
                marker,
                front: OUTSIDE,
                back: 1,
            })
            .to_vec(),
        ..Template::default()
    };
    assert!(crate::names::keeps_names(
        &body([1, 1], [0.5, -0.5]),
        origin,
        axis
    ));
    assert!(!crate::names::keeps_names(
        &body([1, 2], [0.5, -0.5]),
        origin,
        axis
    ));
    // Of their own, each across the plane.
    assert!(crate::names::keeps_names(
        &body([1, 2], [0.0, 0.0]),
        origin,
        axis
    ));
}

#[test]
fn boundary_pieces_that_differ_between_sectors_are_told() {
    let mut body = Body::regular(8, &[1.0, 0.5]).document((8, true), Some(6), 1.0);
    body.markers = vec![Marker {
        id: 1,
        name: "tooth".into(),
        area: None,
    }];
    let area = |document: &Document| -> f64 {
        let body = &document.templates[0];
        let named = body.triangles.iter().filter(|t| t.marker == 1);
        named
            .map(|t| {
                let [a, b, c] = geom::measure::corners(&body.vertices, t);
                geom::measure::triangle_area(a, b, c)
            })
            .sum()
    };
    let told = |body: Document| crate::names::lost(&cut(body, &DEFAULT).unwrap().0);
    let mut alike = body.clone();
    alike.templates[0]
        .triangles
        .iter_mut()
        .for_each(|t| t.marker = 1);
    alike.markers[0].area = Some(area(&alike));
    assert_eq!(told(alike), None);
    // The third part of the triangles, wherever they are.
    let triangles = body.templates[0].triangles.iter_mut().enumerate();
    triangles.for_each(|(i, t)| t.marker = u32::from(i % 3 == 0));
    body.markers[0].area = Some(area(&body));
    let told = told(body).expect("a sentence");
    assert!(
        told.contains("\"tooth\" has ") && told.contains("--order"),
        "{told}"
    );
}

/// The same body with operations that turn the axis over: half turns about the polygon's first corner at half the
/// height, where the twist is half done.
fn turned_over(mut body: Body, kind: Kind, order: u32, place: Option<u64>) -> Document {
    let layers = body.heights.len() - 1;
    body.heights = (0..=layers)
        .map(|k| 2.0 * k as f64 / layers as f64 - 1.0)
        .collect();
    let mut document = body.document((order, false), place, 1.0);
    let (rotation, _) = place.map_or((DMat3::IDENTITY, DVec3::ZERO), placement);
    let symmetry = document.symmetry.as_mut().unwrap();
    symmetry.group = Group::new(kind, order);
    let (sin, cos) = (0.5 * body.twist).sin_cos();
    symmetry.reference = (rotation * DVec3::new(cos, sin, 0.0)).to_array();
    document
}

/// A ring of points at the top, and its image by the rotary reflection of half a step at the bottom, with a band of
/// triangles between them; `sector` has radius and angle, as a part of a step, of an odd number of points.
fn antiprism(kind: Kind, n: u32, sector: &[[f64; 2]], place: Option<u64>) -> Document {
    let count = sector.len() as u32 * n;
    let step = std::f64::consts::TAU / f64::from(n);
    let mut t = Template::default();
    for (z, shift) in [(0.7, 0.0), (-0.7, 0.5)] {
        for k in 0..n {
            for [r, part] in sector {
                let a = step * (f64::from(k) + part + shift);
                t.vertices.push(DVec3::new(r * a.cos(), r * a.sin(), z));
            }
        }
    }
    let middles = [0.7, -0.7].map(|z| {
        t.vertices.push(DVec3::new(0.01, 0.004, z));
        t.vertices.len() as u32 - 1
    });
    let top = |k: u32| k % count;
    let bottom = |k: u32| count + k % count;
    // So many points further on in the other ring.
    let ahead = (sector.len() as u32 - 1) / 2;
    let mut put = |vertices| {
        t.triangles.push(Triangle {
            vertices,
            marker: 1,
            front: OUTSIDE,
            back: 1,
        });
    };
    for k in 0..count {
        let below = bottom(k + count - ahead);
        put([top(k + 1), top(k), below]);
        put([below, bottom(k + count - ahead + 1), top(k + 1)]);
        put([middles[0], top(k), top(k + 1)]);
        put([middles[1], bottom(k + 1), bottom(k)]);
    }
    let (rotation, shift) = place.map_or((DMat3::IDENTITY, DVec3::ZERO), placement);
    for p in &mut t.vertices {
        *p = rotation * *p + shift;
    }
    let mut document = Body::regular(3, &[1.0]).document((n, false), place, 1.0);
    document.templates[0] = t;
    document.symmetry.as_mut().unwrap().group = Group::new(kind, n);
    document
}

fn of_order(order: u32) -> Params {
    Params {
        order: Some(order),
        ..DEFAULT
    }
}

#[test]
fn half_turns_double_the_copies_of_twisted_bars() {
    for place in [None, Some(3), Some(12)] {
        for (n, layers) in [(4, 9), (4, 8), (2, 9), (3, 1), (7, 4), (1, 5)] {
            let mut body = match n {
                1 => Body::regular(1, &[1.0]),
                2 => Body::regular(4, &[1.0]),
                _ => Body::regular(n, &[1.0, 0.4]),
            };
            if n == 2 {
                // A rectangle.
                body.rings[0] = vec![[1.0, 0.4], [-1.0, 0.4], [-1.0, -0.4], [1.0, -0.4]];
            }
            if n == 1 {
                body.rings[0] = vec![
                    [1.0, 0.0],
                    [0.2, 0.5],
                    [-0.4, 0.3],
                    [-0.4, -0.3],
                    [0.2, -0.5],
                ];
            }
            body.heights = vec![0.0; layers + 1];
            body.twist = 0.8;
            let body = turned_over(body, Kind::D, n as u32, place);
            let wedge = check(&body, &of_order(n as u32), 2 * n);
            let walls = if n == 1 { 1 } else { 2 };
            assert_eq!(wedge.templates[0].gluings.len(), walls);
        }
    }
}

#[test]
fn helical_gears_get_all_copies() {
    let n = 16;
    let mut body = Body::regular(4 * n, &[1.0, 0.4]);
    for (k, p) in body.rings[0].iter_mut().enumerate() {
        let r = if matches!(k % 4, 0 | 1 | 3) {
            1.0
        } else {
            0.85
        };
        *p = p.map(|x| r * x);
    }
    body.bore = true;
    body.heights = vec![0.0; 9];
    body.twist = 0.3;
    let body = turned_over(body, Kind::D, n as u32, Some(5));
    for order in [1, 2, 4, 8, 16] {
        check(&body, &of_order(order), 2 * order as usize);
    }
    // Without half turns if only rotations are wanted.
    let params = Params {
        domain: Domain::Rotation,
        ..of_order(16)
    };
    check(&body, &params, 16);
}

#[test]
fn antiprisms_and_rotary_reflections_get_all_copies() {
    for place in [None, Some(2), Some(9)] {
        for n in [1_u32, 2, 3, 4, 7] {
            let chiral = [[1.0, 0.0], [0.9, 0.3], [0.6, 0.7]];
            if n > 1 {
                let body = antiprism(Kind::S, n, &chiral, place);
                check(&body, &of_order(n), 2 * n as usize);
            }
            if n > 2 {
                let body = antiprism(Kind::Dd, n, &[[1.0, 0.0]], place);
                check(&body, &of_order(n), 4 * n as usize);
            }
        }
    }
    // Of an order that leaves an even number of steps there are no rotary reflections.
    let body = antiprism(Kind::S, 4, &[[1.0, 0.0], [0.9, 0.3], [0.6, 0.7]], None);
    check(&body, &of_order(2), 2);
    let body = antiprism(Kind::Dd, 6, &[[1.0, 0.0]], None);
    check(&body, &of_order(2), 8);
    check(&body, &of_order(3), 6);
}

#[test]
fn half_turns_that_cost_twice_the_elements_are_left_out() {
    let params = Params {
        hub: crate::Hub::Auto,
        ..DEFAULT
    };
    let body = antiprism(Kind::Dd, 4, &[[1.0, 0.0]], Some(4));
    let (wedge, _) = crate::cut(body, &params).unwrap();
    // Between mirror planes alone there are as few elements as in the whole; the half turns' plane cuts corners off large
    // faces.
    assert_eq!(wedge.instances.len(), 8);
}

#[test]
fn a_start_angle_that_no_half_turn_has_gives_a_seam() {
    let mut body = Body::regular(4, &[1.0]);
    body.heights = vec![0.0; 9];
    body.twist = 0.8;
    let body = turned_over(body, Kind::D, 4, None);
    for (degrees, copies) in [(45.0_f64, 8), (33.3, 4)] {
        let params = Params {
            start_angle: Some(degrees.to_radians()),
            ..of_order(4)
        };
        check(&body, &params, copies);
    }
}

#[test]
fn the_sector_is_cut_whose_drawing_a_mirror_plane_does_not_sliver() {
    // A circle of 24 facets in which points beside two of the mirror planes of C4v are off them by a hundredth.
    let mut body = Body::regular(24, &[1.0]);
    for k in [0, 3] {
        let angle = std::f64::consts::TAU * k as f64 / 24.0 + 0.01;
        body.rings[0][k] = [angle.cos(), angle.sin()];
    }
    let mut document = body.document((4, true), None, 1.0);
    document.symmetry.as_mut().unwrap().residual = 1e-2;
    let (wedge, _) = cut(document, &DEFAULT).unwrap();
    let template = &wedge.templates[0];
    let lengths = template.triangles.iter().flat_map(|t| {
        let corners = geom::measure::corners(&template.vertices, t);
        (0..3).map(move |k| corners[k].distance(corners[(k + 1) % 3]))
    });
    let shortest = lengths.fold(f64::INFINITY, f64::min);
    assert!(shortest > 0.1, "{shortest}");
}
