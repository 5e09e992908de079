//! How many tests each stage of the search spends: all sampling budgets of the crate, one ladder.
//!
//! `m` tests at places drawn evenly from the surface all miss a flaw that covers the share `p` of it with a
//! probability of about `exp(-m p)`, so that `5 / p` tests overlook one such flaw in 150. Stages that try hundreds of
//! candidates spend few tests on each and leave it to later ones to reject what they let pass; only [`FULL`] and what
//! is proved from faces decide. Each step of the ladder has four times the tests of the one before, so that what is
//! noticed halves in width from step to step. More tests in an early stage cost time in proportion, fewer leave more
//! candidates to the next, dearer stage.

/// Tests of one order where hundreds are ranked for a list: flaws of a third of the surface. The first step, a choice
/// that all others follow from: with four times as many, all that is sampled takes four times as long; with a quarter,
/// already a scan would overlook flaws of less than a third of the surface.
pub const GLANCE: usize = 16;
/// Tests of one of hundreds of orders or angles in a scan, corners by which the width of a flat is measured, and places on
/// each kind of interface that vote for what it goes to: flaws
/// of 8 % of the surface.
pub const SCAN: usize = 4 * GLANCE;
/// Tests for a residual that is only reported: of an order that does not hold, or of one in a plot; and starts of a
/// search on the sphere: flaws of 2 % of the surface.
pub const REPORTED: usize = 4 * SCAN;
/// Tests of one operation, or spread over all of a family, in a quick verification: flaws of 0.5 % of the surface.
pub const QUICK: usize = 4 * REPORTED;
/// Equations of a least-squares adjustment from which a verification goes on, and places on faces at least; the error
/// of a fit to facets, which deviate by the tolerance at most, is that over the root of the number of facets, far
/// below the tolerance.
pub const FIT: usize = 4 * QUICK;
/// Places that means over some hundred neighbourhoods are taken from, a hundred for each; that deviations are looked
/// for at all around the axis; and that a body is compared with a body of revolution at.
pub const SURVEY: usize = 4 * FIT;
/// Vertices, and places on faces, that a surface is represented by at most, and tests of all but the first operation of
/// a full verification: flaws of less than 0.01 % of the surface, and half a second's work.
pub const FULL: usize = 4 * SURVEY;

/// Next best candidates (orders, angles) that are adjusted and verified when the best one does not hold: candidates are
/// local optima of a scan, of which equivalent ones have been merged, so that others are chance. A choice: each takes an
/// adjustment and a quick verification; with fewer, one that holds may be passed over.
pub const NEXT_BEST: usize = 6;
/// Entries of a list in a sentence at most: a line of text holds them. A choice; the report has all of them.
pub const SHOWN: usize = 4;
/// Entries of a list in a report at most: axes, places of a defect, lines of a table. A choice: more than the 30 other
/// axes of an icosahedron, and still looked through by eye.
pub const LISTED: usize = 64;
