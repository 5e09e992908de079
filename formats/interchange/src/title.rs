//! The title line, which carries the promised symmetry through formats that have no place for it.

use crate::text::MAX_TITLE;
use glam::DVec3;
use tmesh::{Document, MAX_TURN_DENOMINATOR, Outside, Promise};

/// The title of a mesh that promises a symmetry:
///
/// ```text
/// symtet C4v order=4 mirror=1 axis=px,py,pz,dx,dy,dz,mx,my,mz outside=16,1,0.14
/// ```
///
/// The Schoenflies symbol, then words `key=value` in this order: `order`, the order of the
/// rotation; `mirror`, 1 when the plane through the axis and the mirror direction is a mirror;
/// `horizontal=1` when the plane through the point across the axis is one (else left out); `axis`,
/// nine numbers: a point of the axis, the axis's direction, the mirror direction, in world
/// coordinates; `outside` if a higher symmetry holds there: order, mirror, and radius. Numbers are
/// the shortest that read back the same. At most 255 characters: where that would be exceeded,
/// directions are rounded, to 15 decimals at least; where that is not enough, `outside` is left out.
pub fn promise_title(promise: &Promise) -> String {
    let Promise {
        order,
        mirror,
        horizontal_mirror,
        rotation: r,
        origin,
        outside,
    } = promise;
    let symbol = match (mirror, horizontal_mirror) {
        (false, false) => format!("C{order}"),
        (true, false) => format!("C{order}v"),
        (false, true) => format!("C{order}h"),
        (true, true) => format!("D{order}h"),
    };
    let horizontal = if *horizontal_mirror {
        " horizontal=1"
    } else {
        ""
    };
    let head = format!(
        "symtet {symbol} order={order} mirror={}{horizontal} axis=",
        u8::from(*mirror)
    );
    let directions = [r[0][2], r[1][2], r[2][2], r[0][0], r[1][0], r[2][0]];
    let write = |decimals: Option<usize>| {
        let point = origin.iter().map(|&x| shortest(x));
        let directions = directions.map(|x| decimals.map_or(shortest(x), |n| rounded(x, n)));
        let all: Vec<_> = point.chain(directions).collect();
        format!("{head}{}", all.join(","))
    };
    let outside = outside.map_or(String::new(), |o| {
        let radius = shortest(o.radius);
        format!(" outside={},{},{radius}", o.order, u8::from(o.mirror))
    });
    let forms = [None, Some(17), Some(16), Some(15)];
    let with = forms.iter().map(|&form| write(form) + &outside);
    let without = forms.iter().map(|&form| write(form));
    let mut titles = with.chain(without);
    let fits = titles.find(|title| title.len() <= MAX_TITLE);
    fits.unwrap_or_else(|| write(Some(15)))
}

/// The promise in a title line that [`promise_title`] made.
pub fn parse_promise(title: &str) -> Option<Promise> {
    let mut words = title.split_ascii_whitespace();
    if words.next() != Some("symtet") {
        return None;
    }
    let (mut order, mut mirror, mut horizontal_mirror, mut numbers) = (None, false, false, None);
    let mut outside = None;
    for word in words {
        match word.split_once('=') {
            Some(("order", v)) => order = parse_order(v),
            Some(("mirror", v)) => mirror = v == "1",
            Some(("horizontal", v)) => horizontal_mirror = v == "1",
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
    let is_unit = |v: DVec3| (v.length() - 1.0).abs() < 1e-9;
    // Two unit vectors whose product is one too are orthogonal.
    let orthonormal = [x, y, z].into_iter().all(is_unit);
    let order = order?;
    let outside = outside.filter(|o| o.order.is_multiple_of(order));
    orthonormal.then_some(Promise {
        order,
        mirror,
        horizontal_mirror,
        rotation: [[x.x, y.x, z.x], [x.y, y.y, z.y], [x.z, y.z, z.z]],
        origin: [n[0], n[1], n[2]],
        outside,
    })
}

/// An order that a document may have.
fn parse_order(text: &str) -> Option<u32> {
    let orders = 1..=MAX_TURN_DENOMINATOR / 2;
    text.parse().ok().filter(|n| orders.contains(n))
}

fn parse_outside(text: &str) -> Option<Outside> {
    let mut parts = text.split(',');
    let order = parse_order(parts.next()?)?;
    let mirror = parts.next()? == "1";
    let radius = parts.next()?.parse().ok();
    let radius = radius.filter(|r| (0.0..f64::INFINITY).contains(r))?;
    parts.next().is_none().then_some(Outside {
        order,
        mirror,
        radius,
    })
}

/// The title of a document's own mesh, each template once.
pub fn document_title(document: &Document) -> String {
    let promise = document.symmetry.as_ref().and_then(|s| s.promise.as_ref());
    match promise {
        Some(promise) if document.is_plain() => promise_title(promise),
        _ if document.instances.len() > 1 => format!(
            "symtet sector: {} of {} instances",
            document.templates.len(),
            document.instances.len()
        ),
        _ => "symtet mesh".to_owned(),
    }
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
    use tmesh::Frame;

    fn promise(frame: Frame) -> Promise {
        let rows = frame.rotation.transpose();
        Promise {
            order: 16,
            mirror: true,
            horizontal_mirror: false,
            rotation: rows.to_cols_array_2d(),
            origin: frame.origin.to_array(),
            outside: None,
        }
    }

    #[test]
    fn what_holds_outside_reads_back() {
        let promise = Promise {
            order: 4,
            outside: Some(Outside {
                order: 16,
                mirror: true,
                radius: 0.1 + 0.2,
            }),
            ..promise(Frame::IDENTITY)
        };
        let title = promise_title(&promise);
        assert!(
            title.ends_with(" outside=16,1,0.30000000000000004"),
            "{title}"
        );
        assert_eq!(parse_promise(&title), Some(promise));
        for odd in [
            "",
            "15,1,1",
            "32772,1,1",
            "16,1",
            "0,1,1",
            "16,1,nan",
            "16,1,-1",
            "16,1,1,1",
        ] {
            let title = format!("symtet C4 order=4 axis=0,0,0,0,0,1,1,0,0 outside={odd}");
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
            "symtet C16v order=16 mirror=1 axis=0,0,0,0,0,1,1,0,0"
        );
        assert_eq!(parse_promise("vtk output"), None);
        assert_eq!(parse_promise("symtet order=4 axis=1,2"), None);
        for odd in [
            "4 axis=0,0,0,1,0,0,2,1,0",
            "4 axis=0,0,0,0,0,1,0,0,1",
            "40000 axis=0,0,0,0,0,1,1,0,0",
        ] {
            assert_eq!(parse_promise(&format!("symtet order={odd}")), None);
        }
    }

    #[test]
    fn titles_fit() {
        let tiny = -1.234_567_890_123_456_7e-101;
        let promise = Promise {
            order: 65_536,
            mirror: true,
            horizontal_mirror: true,
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
            order: 32_768,
            mirror: false,
            radius: -tiny,
        });
        let more = Promise {
            outside,
            ..long.clone()
        };
        assert_eq!(promise_title(&more), promise_title(&long));
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
            order: 8,
            horizontal_mirror: true,
            outside: Some(Outside {
                order: 128,
                mirror: true,
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
