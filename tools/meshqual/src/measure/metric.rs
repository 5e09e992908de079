//! The quality metrics.

use serde::Serialize;

/// A quality metric.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Metric {
    /// Radius of the circumscribed sphere over the shortest edge.
    RadiusEdgeRatio,
    /// Smallest dihedral angle of a tetrahedron, degrees.
    MinDihedral,
    /// Largest dihedral angle of a tetrahedron, degrees.
    MaxDihedral,
    /// Longest edge over 2 sqrt(6) times the radius of the inscribed sphere; 1 when regular.
    AspectRatio,
    /// Edge length, model units. Each tetrahedron contributes its six edges, so an edge weighs as
    /// much as there are tetrahedra around it.
    EdgeLength,
    /// Signed volume of a tetrahedron, model units cubed.
    Volume,
}

/// Where histograms of smallest and of largest dihedral angles begin and end, degrees. Both angles of
/// the regular tetrahedron are 70.53: no smallest one is above, no largest one below. The ends are
/// multiples of 20 beside it.
const SMALLEST_ANGLES: (f64, f64) = (0.0, 80.0);
const LARGEST_ANGLES: (f64, f64) = (60.0, 180.0);

impl Metric {
    /// All metrics, in the order of reports.
    pub const ALL: [Self; 6] = [
        Self::RadiusEdgeRatio,
        Self::MinDihedral,
        Self::MaxDihedral,
        Self::AspectRatio,
        Self::EdgeLength,
        Self::Volume,
    ];

    /// Name on the command line and in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::RadiusEdgeRatio => "radius_edge_ratio",
            Self::MinDihedral => "min_dihedral_deg",
            Self::MaxDihedral => "max_dihedral_deg",
            Self::AspectRatio => "aspect_ratio",
            Self::EdgeLength => "edge_length",
            Self::Volume => "volume",
        }
    }

    /// The metric with this name.
    ///
    /// # Errors
    /// A sentence that says which names there are.
    pub fn parse(name: &str) -> Result<Self, String> {
        let mut all = Self::ALL.into_iter();
        all.find(|m| m.name() == name).ok_or_else(|| {
            let known = Self::ALL.map(Self::name).join(", ");
            format!("there is no metric '{name}'; the metrics are {known}")
        })
    }

    /// Boundaries of `bins` bins for values between `low` and `high`, increasing.
    ///
    /// Angles have the same bins for every mesh, [`SMALLEST_ANGLES`] and [`LARGEST_ANGLES`]. Other
    /// values get bins of equal width, unless they are positive and the first of those would span
    /// more than a factor of two: then bins of equal ratio, which show what small values there are.
    pub fn bins(self, low: f64, high: f64, bins: usize) -> Vec<f64> {
        let (low, high) = match self {
            Self::MinDihedral => SMALLEST_ANGLES,
            Self::MaxDihedral => LARGEST_ANGLES,
            _ => (low, high),
        };
        let ratio = low > 0.0 && (high - low) / bins as f64 > low;
        let mut edges: Vec<f64> = (0..=bins)
            .map(|i| {
                let t = i as f64 / bins as f64;
                match i {
                    0 => low,
                    _ if i == bins => high,
                    _ if ratio => low * libm::pow(high / low, t),
                    _ => low * (1.0 - t) + high * t,
                }
            })
            .collect();
        // Rounding on a very narrow range must not break the order.
        for i in 1..edges.len() {
            edges[i] = edges[i].max(edges[i - 1]).min(high);
        }
        edges
    }
}

impl Serialize for Metric {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bins_are_increasing_and_end_where_the_values_do() {
        for (low, high) in [(1.0, 2.0), (1e-9, 1.0), (-1.0, 3.0), (5.0, 5.0)] {
            for bins in [1, 7, 1000] {
                let edges = Metric::Volume.bins(low, high, bins);
                assert_eq!(edges.len(), bins + 1);
                assert_eq!((edges[0], edges[bins]), (low, high));
                assert!(edges.is_sorted());
            }
        }
        assert_eq!(Metric::MinDihedral.bins(10.0, 60.0, 2), [0.0, 40.0, 80.0]);
    }

    #[test]
    fn names_lead_back() {
        for metric in Metric::ALL {
            assert_eq!(Metric::parse(metric.name()), Ok(metric));
        }
    }
}
