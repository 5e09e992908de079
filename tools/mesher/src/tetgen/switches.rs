//! How TetGen is told what to do.

use crate::{Plc, Task};
use std::fmt::Write;

/// TetGen's switches.
///
/// `p` with the dihedral angle above which triangles of one marker are merged into a facet: only those that were found coplanar
/// share a marker (see [`crate::Facets`]), so that the middle between a fold and a plane does. `q` the bounds, `Aa` makes TetGen read
/// volumes from region seeds: by a volume for all it also divides every edge between facets that is longer than the cube root of that, of edges as
/// long as wanted each into two. `Y` preserves the surface, `nn` asks for adjacency, `J` keeps input points at their numbers, `S` limits
/// the points that are added, `b` says from how many points on they are inserted in random rounds.
pub fn switches(plc: &Plc, task: &Task) -> String {
    let mut text = "p90".to_owned();
    let mut add = |part: std::fmt::Arguments<'_>| {
        // Writing to a string cannot fail.
        let _ = text.write_fmt(part);
    };
    if let Some([radius_edge, min_dihedral]) = task.bounds {
        add(format_args!("q{radius_edge}/{min_dihedral}"));
    }
    if !plc.sizes.is_empty() {
        add(format_args!("Aa"));
    }
    if task.preserve {
        add(format_args!("Y"));
    }
    add(format_args!("nnJ{}", task.switches));
    if let Some(most) = task.most_points {
        add(format_args!("S{most:.0}"));
    }
    if let Some(points) = task.rounds_from {
        add(format_args!("b{points}"));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SizeSeed;

    #[test]
    fn switches_have_no_exponents() {
        let seed = SizeSeed {
            point: [0.0; 3],
            number: 0,
            max_volume: Some(1e-12),
        };
        let mut plc = Plc {
            sizes: vec![seed],
            ..Plc::default()
        };
        let mut task = Task {
            bounds: Some([1.4, 10.0]),
            preserve: true,
            most_points: None,
            rounds_from: None,
            switches: String::new(),
        };
        assert_eq!(switches(&plc, &task), "p90q1.4/10AaYnnJ");
        task.most_points = Some(5e4);
        task.rounds_from = Some(4);
        plc.sizes.clear();
        assert_eq!(switches(&plc, &task), "p90q1.4/10YnnJS50000b4");
        let plain = Task {
            bounds: None,
            preserve: false,
            most_points: None,
            switches: "S7".to_owned(),
            ..task
        };
        assert_eq!(switches(&plc, &plain), "p90nnJS7b4");
    }
}
