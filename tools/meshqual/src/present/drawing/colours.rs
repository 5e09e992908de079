//! Colours of regions and of qualities, red, green and blue from 0 to 255.

const REGIONS: [[f64; 3]; 8] = [
    [92.0, 142.0, 196.0],
    [226.0, 190.0, 92.0],
    [206.0, 116.0, 74.0],
    [128.0, 176.0, 112.0],
    [154.0, 122.0, 180.0],
    [110.0, 180.0, 180.0],
    [196.0, 120.0, 150.0],
    [150.0, 150.0, 150.0],
];

/// Colours of smallest dihedral angles, [`STEP`] apart, from 0 degrees; the last one stands for all
/// larger angles.
const QUALITIES: [[f64; 3]; 5] = [
    [178.0, 24.0, 43.0],
    [239.0, 138.0, 98.0],
    [247.0, 226.0, 160.0],
    [146.0, 197.0, 160.0],
    [33.0, 120.0, 130.0],
];

/// Degrees from one colour to the next: the least angle that the mesher aims at by default is one
/// step, and the angles of well-shaped elements begin where the colours end.
const STEP: f64 = 10.0;

/// Colour of a region, by its position in the list of regions.
pub fn region_colour(position: usize) -> [f64; 3] {
    REGIONS[position % REGIONS.len()]
}

/// Colour of a smallest dihedral angle in degrees.
pub fn quality_colour(degrees: f64) -> [f64; 3] {
    let last = QUALITIES.len() - 1;
    let t = (degrees / STEP).clamp(0.0, last as f64);
    let i = (t as usize).min(last - 1);
    let f = t - i as f64;
    std::array::from_fn(|c| QUALITIES[i][c] * (1.0 - f) + QUALITIES[i + 1][c] * f)
}

/// The angles, in degrees, that have a colour of their own.
pub fn quality_legend() -> impl Iterator<Item = f64> {
    (0..QUALITIES.len()).map(|i| i as f64 * STEP)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn qualities_run_through_all_colours() {
        assert_eq!(quality_colour(0.0), QUALITIES[0]);
        assert_eq!(quality_colour(10.0), QUALITIES[1]);
        assert_eq!(quality_colour(70.0), QUALITIES[4]);
    }
}
