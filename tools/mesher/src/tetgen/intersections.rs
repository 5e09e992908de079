//! Triangles of a complex that intersect, as TetGen's switch `d` finds them.

/// Longest text that is looked at, bytes. A line has fewer than a hundred, and the first pair is the one that is
/// reported, beside their number.
pub const LONGEST_TEXT: usize = 1 << 20;

/// The pairs named in what TetGen prints, of triangles below `count`.
pub fn pairs(text: &str, count: usize) -> Vec<[usize; 2]> {
    let all: Vec<[usize; 2]> = text.lines().filter_map(facet_pair).collect();
    match all.iter().position(|pair| pair.iter().all(|&t| t < count)) {
        Some(first) => {
            // The pair to be shown comes first.
            let mut all = all;
            all.swap(0, first);
            all
        }
        None => Vec::new(),
    }
}

/// Reads a line such as `Facet #12 intersects facet #31 at triangles:`; facets count from 1.
fn facet_pair(line: &str) -> Option<[usize; 2]> {
    let line = line.trim();
    if !line.starts_with("Facet #") {
        return None;
    }
    let mut numbers = line.split('#').skip(1).map(|part| {
        let digits: String = part.chars().take_while(char::is_ascii_digit).collect();
        digits.parse::<usize>().ok()?.checked_sub(1)
    });
    Some([numbers.next()??, numbers.next()??])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_of_facets_are_read() {
        let line = "  Facet #1 intersects facet #33 at triangles:";
        assert_eq!(facet_pair(line), Some([0, 32]));
        assert_eq!(facet_pair("Facet #0 duplicates facet #3"), None);
        assert_eq!(facet_pair("Facet #2"), None);
        assert_eq!(facet_pair("Delaunizing vertices..."), None);
        let text = "Facet #1 intersects facet #99 at\nFacet #2 intersects facet #3 at\n";
        assert_eq!(pairs(text, 5), [[1, 2], [0, 98]]);
        assert!(pairs(text, 2).is_empty());
    }
}
