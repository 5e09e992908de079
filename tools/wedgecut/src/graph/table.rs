//! A seam as a table.

use super::seam::Graph;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

/// A row of the table: its line, and the angle (degrees).
type Row = (usize, f64);

/// Keys in order of their numbers: the bits of a number that is finite, made to increase with it.
fn key(x: f64) -> i64 {
    // Zero has one key, whatever its sign.
    let bits = (x + 0.0).to_bits() as i64;
    bits ^ ((bits >> (u64::BITS - 1)) as u64 >> 1) as i64
}

/// Reads a seam: lines of distance from the axis and height (model units), and angle (degrees), separated by blanks, tabs,
/// commas or semicolons; what follows a `#` is not read, nor is a first line of words. Each distance comes with each height, in
/// any order.
///
/// # Errors
/// What is wrong, with the number of the line.
pub fn read(text: &str) -> Result<Graph, String> {
    let mut rows: BTreeMap<(i64, i64), Row> = BTreeMap::new();
    let mut radii: BTreeMap<i64, (f64, usize)> = BTreeMap::new();
    let mut heights: BTreeMap<i64, (f64, usize)> = BTreeMap::new();
    for (number, line) in (1..).zip(text.lines()) {
        let line = line.split('#').next().unwrap_or_default();
        let is_between = |c: char| c.is_whitespace() || c == ',' || c == ';';
        let words: Vec<&str> = line.split(is_between).filter(|w| !w.is_empty()).collect();
        let is_number = |w: &&str| w.parse::<f64>().is_ok();
        if words.is_empty() || rows.is_empty() && !words.iter().any(is_number) {
            continue;
        }
        let numbers: Vec<f64> = words.iter().filter_map(|w| w.parse().ok()).collect();
        let &[radius, height, angle] = &numbers[..] else {
            return Err(format!(
                "line {number}: a row has three numbers (distance from the axis, height, angle), this has \"{}\"",
                line.trim()
            ));
        };
        if words.len() != numbers.len() || !numbers.iter().all(|x| x.is_finite()) {
            return Err(format!(
                "line {number}: \"{}\" are not three numbers",
                line.trim()
            ));
        }
        if radius < 0.0 {
            return Err(format!(
                "line {number}: the distance from the axis, {radius}, is negative"
            ));
        }
        radii.entry(key(radius)).or_insert((radius, number));
        heights.entry(key(height)).or_insert((height, number));
        match rows.entry((key(radius), key(height))) {
            Entry::Vacant(row) => row.insert((number, angle)),
            Entry::Occupied(row) => {
                return Err(format!(
                    "line {number}: distance {radius} and height {height} have an angle already, in line {}",
                    row.get().0
                ));
            }
        };
    }
    if rows.is_empty() {
        return Err("it has no rows".to_owned());
    }
    let mut angles = Vec::with_capacity(rows.len());
    for (r, (radius, of_radius)) in &radii {
        for (z, (height, of_height)) in &heights {
            let Some((_, angle)) = rows.get(&(*r, *z)) else {
                return Err(format!(
                    "line {}: each distance needs an angle at each height, and there is none for distance {radius} at \
                     height {height}, which is in line {of_height}",
                    of_radius
                ));
            };
            angles.push(angle.to_radians());
        }
    }
    gentle(&radii, &heights, &angles)?;
    let values = |map: BTreeMap<i64, (f64, usize)>| map.into_values().map(|(x, _)| x).collect();
    Ok(Graph::new(values(radii), values(heights), angles))
}

/// Tangent of the steepest seam, 89 degrees: steeper, it has angles below one degree at whatever it ends at, and faces without end
/// have to follow it.
const STEEPEST: f64 = 57.29;

/// Whether a seam with these angles (radians; of all heights at each distance) turns nowhere so steeply that nothing can be meshed.
///
/// # Errors
/// Where it does, with the number of a line.
fn gentle(
    radii: &BTreeMap<i64, (f64, usize)>,
    heights: &BTreeMap<i64, (f64, usize)>,
    angles: &[f64],
) -> Result<(), String> {
    let [radii, heights] = [radii, heights].map(|map| map.values().copied().collect::<Vec<_>>());
    let at = |i: usize, j: usize| angles[i * heights.len() + j];
    let steep = |[a, b]: [f64; 2], radius: f64, apart: f64| {
        let turn = (b - a).abs();
        (turn * radius > STEEPEST * apart).then_some(turn.to_degrees())
    };
    for (i, &(radius, of_radius)) in radii.iter().enumerate() {
        for (j, &(height, of_height)) in heights.iter().enumerate() {
            let up = heights.get(j + 1).and_then(|next| {
                let turn = steep([at(i, j), at(i, j + 1)], radius, next.0 - height)?;
                Some((turn, "height", of_height))
            });
            let out = radii.get(i + 1).and_then(|next| {
                let turn = steep([at(i, j), at(i + 1, j)], next.0, next.0 - radius)?;
                Some((turn, "distance", of_radius))
            });
            if let Some((turn, next, line)) = up.or(out) {
                return Err(format!(
                    "line {line}: from distance {radius} and height {height} to the next {next} the seam turns by {turn} degrees, \
                     more steeply than 89 degrees; give it more room to turn"
                ));
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_read_in_any_order() {
        let graph = read("r, z, theta\n1 0 10\n 1,1,20 # tip\n\n0.5;1;5\n0.5 0 0\n").unwrap();
        assert!((graph.angle(1.0, 0.5).to_degrees() - 15.0).abs() < 1e-12);
        assert!((graph.angle(0.2, 1.0).to_degrees() - 5.0).abs() < 1e-12);
        assert!(read("1 -2 3\n1 2 -3\n1 -0.5 1").is_ok_and(|g| g.angle(1.0, -2.0) > 0.05));
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        for (text, what) in [
            ("1 0 10\n1 1\n", "line 2: a row has three"),
            ("1 0 10\n1 1 x\n", "line 2: a row has three"),
            ("1 0 10\n1 1 2 x\n", "line 2: \"1 1 2 x\" are not"),
            ("1 0 10\n\n1 1 inf\n", "line 3: \"1 1 inf\" are not"),
            ("-1 0 10\n", "line 1: the distance"),
            ("1 0 10\n1 0 11\n", "already, in line 1"),
            ("1 0 10\n2 1 11\n", "line 1: each distance needs"),
            ("# nothing\n", "no rows"),
            (
                "1 0 0\n1 1 0\n1 1.0000001 20\n",
                "line 2: from distance 1 and height 1 to the next height",
            ),
            (
                "1 0 0\n1.001 0 20\n",
                "line 1: from distance 1 and height 0 to the next distance",
            ),
        ] {
            let told = read(text).unwrap_err();
            assert!(told.contains(what), "{text}: {told}");
        }
    }
}
