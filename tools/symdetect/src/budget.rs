//! How many tests each stage of the search spends: all sampling budgets of the crate.
//!
//! `m` tests at places drawn evenly from the surface all miss a flaw that covers the share `p` of it with a
//! probability of about `exp(-m p)`, so that `5 / p` tests overlook one such flaw in 150. Stages that try hundreds of
//! candidates spend few tests on each and leave it to later ones to reject what they let pass; only [`FULL`] and what
//! is proved from faces decide. More tests in an early stage cost time in proportion, fewer leave more candidates to
//! the next, dearer stage.

use std::ops::Range;

/// Tests of one order where hundreds are ranked for a list: flaws of a fifth of the surface.
pub const GLANCE: usize = 24;
/// Tests of one of hundreds of orders or angles in a scan: flaws of 5 % of the surface.
pub const SCAN: usize = 96;
/// Tests of one of hundreds of angles, whose deviations are added up: flaws of 8 % of the surface.
pub const SCORE: usize = 64;
/// Tests for a residual that is only reported: of an order that does not hold, or of one in a plot.
pub const REPORTED: usize = 600;
/// Tests of one operation, or spread over all of a family, in a quick verification: flaws of 0.3 % of the surface.
pub const QUICK: usize = 1_500;
/// Equations of a least-squares adjustment from which a verification goes on; the error of a fit to facets, which
/// deviate by the tolerance at most, is that over the root of the number of facets, far below the tolerance.
pub const FIT: usize = 4_000;
/// Tests of everything but the first operation of a full verification, at least and at most: flaws of 0.06 % of a small
/// surface, and half a second's work on a large one.
pub const FULL: Range<usize> = 8_000..60_000;
/// Tests, equations or places for each triangle in a full verification and in the last adjustment, within the bounds
/// above: every triangle is looked at from all powers of a rotation together.
pub const PER_TRIANGLE: usize = 8;
/// Places that means over neighbourhoods are taken from: a hundred for each of some hundred of them.
pub const NEIGHBOURHOODS: usize = 12_000;
/// Places at which deviations are looked for all around the axis: several for each of some hundred sectors of each shell.
pub const ALL_AROUND: usize = 16_000;
/// Tests of an order that is listed as not holding, and corners that powers of an operation proved from faces are
/// measured in: a maximum over so many places is the largest but for a hundredth of the surface.
pub const LISTED: usize = 128;
/// Places that regions vote at, and that a body is compared with a body of revolution at.
pub const SURVEY: usize = 20_000;
/// Next best candidates (orders, angles) that are adjusted and verified when the best one does not hold: candidates are
/// local optima of a scan, of which equivalent ones have been merged, so that others are chance.
pub const NEXT_BEST: usize = 6;
/// Axes, or candidates for axes, looked at or listed at most beside the principal ones: a polyhedral group has up to 31
/// axes and as many normals of mirror planes, and a D_64 has 64 half turns.
pub const MOST_AXES: usize = 64;
