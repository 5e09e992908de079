//! Where parts of a surface meet that should not.

use geom::contacts::{Contact, Search, contacts};
use glam::DVec3;

/// Contacts among which the lowest one is sought. Fewer make the place in a message depend on the order
/// of the search for more files, more take longer on surfaces that cross themselves everywhere.
const COMPARED: usize = 1000;

/// The contact between triangles of different groups, among those that `matters` accepts, that is lowest
/// in x, then y, then z; and whether the search came to an end.
pub fn lowest_contact(
    points: &[DVec3],
    triangles: &[[u32; 3]],
    group: impl Fn(u32) -> u32,
    matters: impl Fn(&Contact) -> bool,
) -> (Option<Contact>, Search) {
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
        count < COMPARED
    });
    (lowest, search)
}
