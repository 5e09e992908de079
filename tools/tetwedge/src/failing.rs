//! What elements that fail what is asked for weigh.

/// What an element that fails what is asked for weighs against others. A choice: the first percentile is what is asked of a mesh, and where
/// one in a hundred fails, these weigh as much as all others.
pub const FAILING: usize = 100;

/// Where one in so many elements fails, it is the shape, and no coarsening helps: a thin layer drawn with needles takes a minute to improve, and
/// another one for nothing. Impellers have one in thirty.
const HOPELESS: usize = 10;

/// Whether so many elements fail that nothing else is worth trying.
pub fn is_hopeless(failing: usize, elements: usize) -> bool {
    HOPELESS * failing > elements
}
