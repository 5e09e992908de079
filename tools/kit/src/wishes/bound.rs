//! The bounds that a document's wishes come to.

use crate::number;
use geom::tet::TetMeasures;
use tmesh::{Document, Size};

/// What a bound is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Smallest dihedral angle, degrees.
    Dihedral,
    /// Circumradius over shortest edge.
    RadiusEdge,
    /// Volume, model units cubed.
    Volume,
}

/// A bound on elements.
#[derive(Clone, Debug, PartialEq)]
pub struct Bound {
    pub measure: Measure,
    pub asked: f64,
    /// What elements are compared with: `asked`, or the cotangent of that angle, as taking the angles of all elements
    /// would take longer than all else.
    limit: f64,
    /// What was asked, as a message says it.
    pub words: String,
    /// Regions that it holds for; `None` for all.
    regions: Option<Vec<u32>>,
}

impl Measure {
    pub fn name(self) -> &'static str {
        match self {
            Self::Dihedral => "dihedral",
            Self::RadiusEdge => "radius-edge ratio",
            Self::Volume => "volume",
        }
    }

    /// The side of the bound on which elements fail.
    pub fn side(self) -> &'static str {
        match self {
            Self::Dihedral => "below",
            Self::RadiusEdge | Self::Volume => "above",
        }
    }

    /// The value of an element.
    pub fn of(self, element: &TetMeasures) -> f64 {
        match self {
            Self::Dihedral => element.min_dihedral().to_degrees(),
            Self::RadiusEdge => element.radius_edge_ratio,
            Self::Volume => element.volume,
        }
    }

    /// How bad a value is; of two values the worse one has more.
    pub fn badness(self, value: f64) -> f64 {
        match self {
            Self::Dihedral => -value,
            Self::RadiusEdge | Self::Volume => value,
        }
    }
}

impl Bound {
    /// The bounds that a document says were asked for; none where no quality was.
    pub fn of(document: &Document) -> Vec<Self> {
        let wishes = &document.wishes;
        if !wishes.quality() {
            return Vec::new();
        }
        let everywhere = |measure: Measure, asked: Option<f64>| {
            asked.map(|asked| Self {
                measure,
                asked,
                limit: match measure {
                    Measure::Dihedral => libm::tan(asked.to_radians()).recip(),
                    Measure::RadiusEdge | Measure::Volume => asked,
                },
                words: format!("{} asked for", number(asked)),
                regions: None,
            })
        };
        let mut bounds = Vec::new();
        bounds.extend(everywhere(Measure::Dihedral, wishes.min_dihedral));
        bounds.extend(everywhere(Measure::RadiusEdge, wishes.radius_edge));
        bounds.extend(wishes.size.map(|size| Self::of_size(document, size)));
        for region in &document.regions {
            if let Some(size) = region.size {
                let asked = size.max_volume();
                bounds.push(Self {
                    measure: Measure::Volume,
                    asked,
                    limit: asked,
                    words: format!("{} in '{}'", asked_for(size), region.name),
                    regions: Some(vec![region.id]),
                });
            }
        }
        bounds
    }

    /// The general bound of the size, for regions that have none of their own.
    fn of_size(document: &Document, size: Size) -> Self {
        let asked = size.max_volume();
        let words = asked_for(size);
        let own = document.regions.iter().any(|r| r.size.is_some());
        let without = document.regions.iter().filter(|r| r.size.is_none());
        Self {
            measure: Measure::Volume,
            asked,
            limit: asked,
            words,
            regions: own.then(|| without.map(|r| r.id).collect()),
        }
    }

    /// The value of an element that is beyond the bound.
    pub fn beyond(&self, element: &TetMeasures) -> Option<f64> {
        let fails = match self.measure {
            Measure::Dihedral => element.has_dihedral_below(self.limit),
            Measure::RadiusEdge => element.radius_edge_ratio > self.limit,
            Measure::Volume => element.volume > self.limit,
        };
        fails.then(|| self.measure.of(element))
    }

    /// Whether it holds for a region.
    pub fn holds_for(&self, region: u32) -> bool {
        let regions = self.regions.as_ref();
        regions.is_none_or(|regions| regions.contains(&region))
    }
}

/// The volume of a size, as a message says it.
fn asked_for(size: Size) -> String {
    let volume = number(size.max_volume());
    match size {
        Size::MaxVolume(_) => format!("{volume} asked for"),
        Size::EdgeLength(edge) => format!("{volume} asked for by edges of {}", number(edge)),
    }
}
