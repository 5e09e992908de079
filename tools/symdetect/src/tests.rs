use crate::{Params, bodies, detect};

#[test]
fn a_prism() {
    for n in [3, 4, 5, 6, 7, 12, 53, 128] {
        let body = bodies::prism(n, 1.0, 0.7);
        let found = detect(&body, &Params::default(), &mut |t| eprintln!("{t}")).unwrap();
        eprintln!("{n}: {:?} {:?}", found.symmetry, found.notes);
        assert_eq!(found.symmetry.order as usize, n);
    }
}
