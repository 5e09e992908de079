//! Triangles of a complex that intersect, as TetGen's switch `d` finds them.

/// The pairs named in lines that TetGen prints, the first one of triangles below `count`; none if there is no such pair.
pub fn pairs<'a>(lines: impl Iterator<Item = &'a str>, count: usize) -> Vec<[usize; 2]> {
    let mut all: Vec<[usize; 2]> = lines.filter_map(facet_pair).collect();
    match all.iter().position(|pair| pair.iter().all(|&t| t < count)) {
        Some(first) => all.swap(0, first),
        None => all.clear(),
    }
    all
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
        assert_eq!(pairs(text.lines(), 5), [[1, 2], [0, 98]]);
        assert!(pairs(text.lines(), 2).is_empty());
    }
}
