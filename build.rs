//! Where the tools look for TetGen's library before the system's places: in `lib/symtet` beside their folder, where
//! the archive and the wheel carry it. A `.deb` and `make install` have nothing there, and the system's is taken.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("linux") {
        println!("cargo::rustc-link-arg-bins=-Wl,-rpath,$ORIGIN/../lib/symtet");
    }
}
