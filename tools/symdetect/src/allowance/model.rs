//! The numbers of the model that tells facets of smooth surfaces from features, all in one place.
//!
//! They are choices, made so that made wheels with bores of 16 to 40 facets are read and the same with an oval, an
//! eccentric or a grooved bore are not (`cargo test -p symdetect --release -- --ignored facets_and_flaws`). A model
//! that knows the arcs themselves would need none of them.

/// What facets may add to the tolerance at most, in tolerances. Exactness of drawings is commonly stated as a share of
/// the diagonal of the box; the diagonal of the square around the circle of the radius is `2 sqrt 2` radii, so that
/// drawings as exact as the tolerance deviate by `2 sqrt 2` tolerances, one of which is allowed everywhere.
pub const FACETS: f64 = 2.0 * std::f64::consts::SQRT_2 - 1.0;

/// Bulge of some facet, in tolerances, from which on facets are taken into account. Smaller ones could explain a tenth
/// of a tolerance at most, and no tolerance is meant that exactly.
pub const COARSE: f64 = 0.1;

/// Share of the largest deviation that a place must have for it to count as deviating too: at nine
/// in ten phases the corner of a facet is that share of the sagitta off another facet.
pub const NOTICEABLE: f64 = 0.33;

/// Sectors around the axis that are one neighbourhood each: few enough that there are several facets in each of them
/// on a coarse bore, and enough that an oval, which changes sign four times around, does not cancel in one.
pub const SECTORS: u32 = 6;

/// Shells around the axis that are told apart: surfaces at clearly different distances deviate for reasons of their
/// own. Twice as many part a small bore from its surroundings, half as many do when sectors already part them.
pub const SHELLS: f64 = 4.0;

/// Displacements in a sector from which their mean is taken for more than chance.
pub const FEWEST_IN_SECTOR: f64 = 12.0;

/// Displacements in a shell from which waves are fitted: several for each of their seven coefficients.
pub const FEWEST_IN_SHELL: usize = 60;

/// Size of slow waves in the displacement of a shell, in limits, that facets alone may make on coarse drawings.
pub const SWINGS: f64 = 1.2;

/// Displacements, in limits, beyond which an image has landed on something else.
pub const REACH: f64 = 16.0;

/// Orders whose deviations may turn out not to be those of facets before no more high ones are allowed any:
/// near a body of revolution, a flaw that facets could explain where it is spoils hundreds alike.
pub const UNEXPLAINED: usize = 8;

/// Orders up to this one are allowed them even so: those of nearly all parts that are not bodies of revolution.
pub const LOW: u32 = 12;
