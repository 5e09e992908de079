//! The title line, which carries the promised symmetry through formats that have no place for it.

use crate::text::MAX_TITLE;
use glam::DVec3;
use tmesh::{Document, Group, Outside, Promise, ROUNDING};

/// The title of a mesh that promises a symmetry:
///
/// ```text
/// symtet C4v axis=px,py,pz,dx,dy,dz,mx,my,mz outside=C16v,0.14
/// ```
///
/// The group, then words `key=value` in this order: `axis`, nine numbers: a point of the axis that all
/// operations leave in place, the axis's direction, the direction of the canonical x axis, in world
/// coordinates; `outside` if a higher symmetry holds there: group and radius. Numbers are the
/// shortest that read back the same. At most 255 characters: where that would be exceeded,
/// directions are rounded, to 15 decimals at least, with which every promise fits.
pub fn promise_title(promise: &Promise) -> String {
    let Promise {
        group,
        rotation: r,
        origin,
        outside,
    } = promise;
    let head = format!("symtet {group} axis=");
    let directions = [r[0][2], r[1][2], r[2][2], r[0][0], r[1][0], r[2][0]];
    let write = |decimals: Option<usize>| {
        let point = origin.iter().map(|&x| shortest(x));
        let directions = directions.map(|x| decimals.map_or(shortest(x), |n| rounded(x, n)));
        let all: Vec<_> = point.chain(directions).collect();
        format!("{head}{}", all.join(","))
    };
    let outside = outside.map_or(String::new(), |o| {
        let radius = shortest(o.radius);
        format!(" outside={},{radius}", o.group)
    });
    let forms = [None, Some(17), Some(16), Some(15)];
    let mut titles = forms.iter().map(|&form| write(form) + &outside);
    let fits = titles.find(|title| title.len() <= MAX_TITLE);
    fits.unwrap_or_else(|| write(Some(15)) + &outside)
}

/// The promise in a title line that [`promise_title`] made.
pub fn parse_promise(title: &str) -> Option<Promise> {
    let mut words = title.split_ascii_whitespace();
    if words.next() != Some("symtet") {
        return None;
    }
    let group: Group = words.next()?.parse().ok()?;
    let (mut numbers, mut outside) = (None, None);
    for word in words {
        match word.split_once('=') {
            Some(("axis", v)) => {
                let parsed: Result<Vec<f64>, _> = v.split(',').map(str::parse).collect();
                numbers = parsed.ok().and_then(|n| <[f64; 9]>::try_from(n).ok());
            }
            Some(("outside", v)) => outside = parse_outside(v),
            _ => {}
        }
    }
    let n = numbers.filter(|n| n.iter().all(|x| x.is_finite()))?;
    let z = DVec3::new(n[3], n[4], n[5]);
    let x = DVec3::new(n[6], n[7], n[8]);
    let y = z.cross(x);
    let is_unit = |v: DVec3| (v.length() - 1.0).abs() < ROUNDING;
    // Two unit vectors whose product is one too are orthogonal.
    let orthonormal = [x, y, z].into_iter().all(is_unit);
    let outside = outside.filter(|o: &Outside| o.group.order.is_multiple_of(group.order));
    orthonormal.then_some(Promise {
        group,
        rotation: [[x.x, y.x, z.x], [x.y, y.y, z.y], [x.z, y.z, z.z]],
        origin: [n[0], n[1], n[2]],
        outside,
    })
}

fn parse_outside(text: &str) -> Option<Outside> {
    let (group, radius) = text.split_once(',')?;
    let group = group.parse().ok()?;
    let radius = radius.parse().ok();
    let radius = radius.filter(|r| (0.0..f64::INFINITY).contains(r))?;
    Some(Outside { group, radius })
}

/// How the title of a sector begins.
const SECTOR: &str = "symtet sector: ";

/// The title of a document's own mesh, each template once.
pub fn document_title(document: &Document) -> String {
    match &document.promise {
        Some(promise) if document.is_plain() => promise_title(promise),
        _ if document.instances.len() > 1 => format!(
            "{SECTOR}{} of {} instances",
            document.templates.len(),
            document.instances.len()
        ),
        _ => "symtet mesh".to_owned(),
    }
}

/// The number of instances of the whole in the title of a sector that [`document_title`] made.
pub fn parse_sector(title: &str) -> Option<u32> {
    let counts = title.strip_prefix(SECTOR)?.strip_suffix(" instances")?;
    counts.split_once(" of ")?.1.parse().ok()
}

fn shortest(x: f64) -> String {
    let (plain, exponent) = (format!("{x}"), format!("{x:e}"));
    if exponent.len() < plain.len() {
        exponent
    } else {
        plain
    }
}

fn rounded(x: f64, decimals: usize) -> String {
    let text = format!("{x:.decimals$}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use tmesh::{Frame, Kind};

    fn promise(frame: Frame) -> Promise {
        let rows = frame.rotation.transpose();
        Promise {
            group: Group::new(Kind::Cv, 16),
            rotation: rows.to_cols_array_2d(),
            origin: frame.origin.to_array(),
            outside: None,
        }
    }

    #[test]
    fn what_holds_outside_reads_back() {
        let promise = Promise {
            group: Group::new(Kind::Cv, 4),
            outside: Some(Outside {
                group: Group::new(Kind::Cv, 16),
                radius: 0.1 + 0.2,
            }),
            ..promise(Frame::IDENTITY)
        };
        let title = promise_title(&promise);
        assert!(
            title.ends_with(" outside=C16v,0.30000000000000004"),
            "{title}"
        );
        assert_eq!(parse_promise(&title), Some(promise));
        for odd in [
            "",
            "C15v,1",
            "C32772v,1",
            "C16v",
            "C0,1",
            "C16v,nan",
            "C16v,-1",
            "C16v,1,1",
        ] {
            let title = format!("symtet C4 axis=0,0,0,0,0,1,1,0,0 outside={odd}");
            let promise = parse_promise(&title).unwrap();
            assert_eq!(promise.outside, None, "{odd}");
        }
    }

    #[test]
    fn titles_read_back() {
        let frame = Frame::from_axis(
            DVec3::new(0.1, -2e-7, 3e9),
            DVec3::new(1.0, 2.0, -0.3),
            DVec3::Y,
        )
        .unwrap();
        for promise in [promise(Frame::IDENTITY), promise(frame)] {
            let title = promise_title(&promise);
            let back = parse_promise(&title).unwrap();
            assert_eq!(back.origin, promise.origin);
            for i in 0..3 {
                assert_eq!(back.rotation[i][0], promise.rotation[i][0]);
                assert_eq!(back.rotation[i][2], promise.rotation[i][2]);
                assert!((back.rotation[i][1] - promise.rotation[i][1]).abs() < 1e-15);
            }
        }
        assert_eq!(
            promise_title(&self::promise(Frame::IDENTITY)),
            "symtet C16v axis=0,0,0,0,0,1,1,0,0"
        );
        assert_eq!(parse_promise("vtk output"), None);
        assert_eq!(parse_promise("symtet C4 axis=1,2"), None);
        for odd in [
            "C4 axis=0,0,0,1,0,0,2,1,0",
            "C4 axis=0,0,0,0,0,1,0,0,1",
            "C40000 axis=0,0,0,0,0,1,1,0,0",
            "axis=0,0,0,0,0,1,1,0,0",
        ] {
            assert_eq!(parse_promise(&format!("symtet {odd}")), None);
        }
    }

    #[test]
    fn titles_fit() {
        let tiny = -1.234_567_890_123_456_7e-101;
        let promise = Promise {
            group: Group::new(Kind::Dh, 32_768),
            rotation: [[tiny; 3], [-0.987_654_321_098_765_4; 3], [tiny; 3]],
            origin: [tiny; 3],
            outside: None,
        };
        assert!(promise_title(&promise).len() <= MAX_TITLE);
        let long = Promise {
            rotation: [[-0.987_654_321_098_765_4; 3]; 3],
            ..promise
        };
        let outside = Some(Outside {
            group: Group::new(Kind::C, 32_768),
            radius: -tiny,
        });
        let more = Promise { outside, ..long };
        let title = promise_title(&more);
        assert!(title.len() <= MAX_TITLE && title.contains(" outside=C32768,"));
        // A via anywhere in space, cut by mirrors in every direction.
        let frame = Frame::from_axis(
            DVec3::new(
                -0.505_182_428_527_566_8,
                -0.053_240_172_047_687_88,
                -1.0 / 7.0,
            ),
            DVec3::new(1.0, -2.0, 0.3),
            DVec3::Y,
        )
        .unwrap();
        let via = Promise {
            group: Group::new(Kind::Dh, 8),
            outside: Some(Outside {
                group: Group::new(Kind::Cv, 128),
                radius: 0.123_457,
            }),
            ..super::tests::promise(frame)
        };
        let title = promise_title(&via);
        assert!(title.len() <= MAX_TITLE);
        let back = parse_promise(&title).unwrap();
        assert_eq!(back.outside, via.outside, "{title}");
        for (row, expected) in back.rotation.iter().zip(via.rotation) {
            let off = DVec3::from_array(*row) - DVec3::from_array(expected);
            assert!(off.abs().max_element() < 2e-15, "{title}");
        }
    }
}
