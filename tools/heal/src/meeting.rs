//! Where parts of a surface meet that should not.

use geom::contacts::{Contact, Search, contacts};
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

/// The contacts between triangles of different groups, among those that `matters` accepts.
pub fn meetings(
    points: &[DVec3],
    triangles: &[[u32; 3]],
    group: impl Fn(u32) -> u32,
    matters: impl Fn(&Contact) -> bool,
) -> Meetings {
    let mut lowest: Option<Contact> = None;
    let mut count = 0;
    let search = contacts(points, triangles, group, |contact| {
        if matters(&contact) {
            count += 1;
            let key = |c: &Contact| (c.point.to_array(), c.triangles);
            let is_lower = |known: &Contact| key(&contact) < key(known);
            if lowest.as_ref().is_none_or(is_lower) {
                lowest = Some(contact);
            }
        }
        true
    });
    Meetings {
        lowest,
        count,
        search,
    }
}
