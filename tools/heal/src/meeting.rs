//! Where parts of a surface meet that should not.

use geom::contacts::{Contact, Search, contact, contacts};
use glam::DVec3;

/// Contacts between triangles of different groups.
pub struct Meetings {
    /// The one that is lowest in x, then y, then z.
    pub lowest: Option<Contact>,
    /// How many were found.
    pub count: usize,
    /// Whether the search came to an end.
    pub search: Search,
}

/// Triangles whose pairs are all looked at: as many as a tree would look at anyway, those around each one.
const FEW: usize = 12;

impl Meetings {
    const NONE: Self = Self {
        lowest: None,
        count: 0,
        search: Search::Done,
    };

    fn add(&mut self, contact: Contact) {
        let key = |c: &Contact| (c.point.to_array(), c.triangles);
        let is_lower = |known: &Contact| key(&contact) < key(known);
        self.count += 1;
        if self.lowest.as_ref().is_none_or(is_lower) {
            self.lowest = Some(contact);
        }
    }
}

/// The contacts between triangles of different groups, among those that `matters` accepts.
pub fn meetings(
    points: &[DVec3],
    triangles: &[[u32; 3]],
    group: impl Fn(u32) -> u32,
    matters: impl Fn(&Contact) -> bool,
) -> Meetings {
    let mut met = Meetings::NONE;
    met.search = contacts(points, triangles, group, |contact| {
        if matters(&contact) {
            met.add(contact);
        }
        true
    });
    met
}

/// The contacts between triangles of the same group, numbered from zero on.
pub fn meetings_within(points: &[DVec3], triangles: &[[u32; 3]], group: &[u32]) -> Meetings {
    let mut met = Meetings::NONE;
    met.search = contacts_within(points, triangles, group, |contact| met.add(contact));
    met
}

/// Pairs of triangles of different groups that meet away from common vertices and edges, all there are.
pub struct Met {
    /// The pairs, the lower one first.
    pub pairs: Vec<[u32; 2]>,
    /// The group of each triangle, numbered from zero on.
    pub group: Vec<u32>,
}

/// Calls `found` with the contacts between triangles of the same group, numbered from zero on.
pub fn contacts_within(
    points: &[DVec3],
    triangles: &[[u32; 3]],
    group: &[u32],
    mut found: impl FnMut(Contact),
) -> Search {
    let count = group.iter().max().map_or(0, |m| *m as usize + 1);
    let mut members = vec![Vec::new(); count];
    for (t, &g) in (0..).zip(group) {
        members[g as usize].push(t);
    }
    let mut end = Search::Done;
    for members in &members {
        let own: Vec<[u32; 3]> = members.iter().map(|&t| triangles[t as usize]).collect();
        let mut found = |[i, j]: [usize; 2], point| {
            found(Contact {
                triangles: [members[i], members[j]],
                point,
            });
        };
        if own.len() <= FEW {
            for j in 1..own.len() {
                for i in 0..j {
                    if let Some(point) = contact(points, &own[i], &own[j]) {
                        found([i, j], point);
                    }
                }
            }
            continue;
        }
        let search = contacts(
            points,
            &own,
            |t| t,
            |contact| {
                found(contact.triangles.map(|t| t as usize), contact.point);
                true
            },
        );
        if search == Search::GaveUp {
            end = search;
        }
    }
    end
}
