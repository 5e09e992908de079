//! Orbits of feature edges: edges that are images of each other under the steps of all pairings.

use super::features::Features;
use super::pairing::Pairing;
use rustc_hash::FxHashMap;

/// That one edge is the image of another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// Number of the pairing.
    pub pairing: usize,
    /// Master edge.
    pub from: usize,
    /// Its image.
    pub to: usize,
    /// Whether the image runs the other way, from the lower to the higher vertex number.
    pub reversed: bool,
}

/// How an edge is reached from the one that its orbit is made from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Member {
    /// The edge.
    pub edge: usize,
    /// The link that leads to it, and whether it is followed from the image to the master; none for the first.
    pub by: Option<(usize, bool)>,
    /// Whether it runs the other way than the first.
    pub reversed: bool,
}

/// Edges that get one division.
#[derive(Clone, Debug, PartialEq)]
pub struct Orbit {
    /// The members, the one that the others are made from first, each after the one that its link comes from.
    pub members: Vec<Member>,
    /// Whether a link takes an edge onto itself the other way round, so that the division is symmetric.
    pub folded: bool,
}

/// The links of all pairings, those of an edge onto itself included.
pub fn links(features: &Features, pairings: &[Pairing]) -> Vec<Link> {
    let mut links = Vec::new();
    for (number, pairing) in pairings.iter().enumerate() {
        let image: FxHashMap<u32, u32> = pairing.vertices.iter().map(|p| (p[0], p[1])).collect();
        for (from, [a, b]) in features.ends.iter().enumerate() {
            if let (Some(&p), Some(&q)) = (image.get(a), image.get(b))
                && let Some((to, reversed)) = features.find(p, q)
            {
                links.push(Link {
                    pairing: number,
                    from,
                    to,
                    reversed,
                });
            }
        }
    }
    links
}

/// The orbits of `count` edges, in the order of the edges that they are made from: the first one that is no other's image,
/// or, where each is, the first one.
pub fn orbits(count: usize, links: &[Link]) -> Vec<Orbit> {
    let mut at: Vec<Vec<usize>> = vec![Vec::new(); count];
    let mut is_image = vec![false; count];
    for (i, link) in links.iter().enumerate() {
        at[link.from].push(i);
        if link.to != link.from {
            at[link.to].push(i);
            is_image[link.to] = true;
        }
    }
    let mut known = vec![false; count];
    let mut orbits = Vec::new();
    let masters = (0..count).filter(|&edge| !is_image[edge]);
    for first in masters.chain(0..count) {
        if !known[first] {
            orbits.push(orbit(first, links, &at, &mut known));
        }
    }
    orbits.sort_by_key(|orbit| orbit.members[0].edge);
    orbits
}

fn orbit(first: usize, links: &[Link], at: &[Vec<usize>], known: &mut [bool]) -> Orbit {
    known[first] = true;
    let mut orbit = Orbit {
        members: vec![Member {
            edge: first,
            by: None,
            reversed: false,
        }],
        folded: false,
    };
    let mut next = 0;
    while let Some(&Member { edge, reversed, .. }) = orbit.members.get(next) {
        next += 1;
        for &i in &at[edge] {
            let link = links[i];
            let back = link.from != edge;
            let other = if back { link.from } else { link.to };
            let turned = reversed != link.reversed;
            if !known[other] {
                known[other] = true;
                orbit.members.push(Member {
                    edge: other,
                    by: Some((i, back)),
                    reversed: turned,
                });
            } else if let Some(member) = orbit.members.iter().find(|m| m.edge == other) {
                orbit.folded |= member.reversed != turned;
            }
        }
    }
    orbit
}

#[cfg(test)]
mod tests {
    use super::*;

    fn link(from: usize, to: usize, reversed: bool) -> Link {
        Link {
            pairing: 0,
            from,
            to,
            reversed,
        }
    }

    fn edges(orbit: &Orbit) -> Vec<usize> {
        orbit.members.iter().map(|m| m.edge).collect()
    }

    #[test]
    fn edges_are_made_from_the_one_that_is_no_image() {
        let links = [link(2, 0, true), link(1, 1, false)];
        let found = orbits(4, &links);
        let all: Vec<Vec<usize>> = found.iter().map(edges).collect();
        assert_eq!(all, [vec![1], vec![2, 0], vec![3]]);
        assert!(found[1].members[1].reversed && !found[1].folded);
    }

    #[test]
    fn edges_of_the_axis_that_two_pairings_share_are_one_orbit() {
        // Each takes the lower one onto the upper one and back.
        let links = [link(0, 1, true), link(1, 0, true), link(0, 1, true)];
        let found = orbits(2, &links);
        assert_eq!(found.len(), 1);
        assert_eq!(edges(&found[0]), [0, 1]);
        assert!(!found[0].folded);
        // What runs through the middle is its own image, turned round.
        assert!(orbits(1, &[link(0, 0, true)])[0].folded);
        // And so is what comes back the other way round.
        let links = [link(0, 1, false), link(1, 0, true)];
        assert!(orbits(2, &links)[0].folded);
    }
}
