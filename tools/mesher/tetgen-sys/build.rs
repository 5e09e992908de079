//! Builds the shim and links the system's TetGen library.
//!
//! `TETGEN_INCLUDE_DIR` and `TETGEN_LIB_DIR` name other places than the system's.

use std::env;
use std::io::Write;
use std::process::{Command, Stdio};

const HINT: &str = "install libtet1.5-dev, or run `make setup`; for a TetGen elsewhere set \
                    TETGEN_INCLUDE_DIR and TETGEN_LIB_DIR";

fn main() {
    for file in [
        "shim/tetgen_shim.cpp",
        "shim/tetgen_shim.h",
        "shim/watch.cpp",
        "shim/watch.h",
        "shim/sizes.cpp",
        "shim/sizes.h",
        "shim/result.cpp",
        "shim/result.h",
    ] {
        println!("cargo:rerun-if-changed={file}");
    }
    println!("cargo:rerun-if-env-changed=TETGEN_INCLUDE_DIR");
    println!("cargo:rerun-if-env-changed=TETGEN_LIB_DIR");
    let include = env::var("TETGEN_INCLUDE_DIR").ok();
    let library = env::var("TETGEN_LIB_DIR").ok();

    let mut build = cc::Build::new();
    build
        .cpp(true)
        .std("c++17")
        .define("TETLIBRARY", None)
        .flag_if_supported("-Wno-unused-parameter");
    if let Some(folder) = &include {
        build.include(folder);
    }
    let compiler = build.get_compiler();

    let mut preprocess = compiler.to_command();
    preprocess.args(["-E", "-x", "c++", "-"]);
    if !accepts(preprocess, "#include <tetgen.h>\n") {
        fail("the header tetgen.h was not found");
    }
    let mut link = compiler.to_command();
    if let Some(folder) = &library {
        link.arg(format!("-L{folder}"));
        println!("cargo:rustc-link-search=native={folder}");
    }
    link.args(["-x", "c++", "-", "-o", "/dev/null", "-ltet"]);
    if !accepts(link, "int main() { return 0; }\n") {
        fail("the TetGen library (libtet) was not found");
    }

    build
        .file("shim/tetgen_shim.cpp")
        .file("shim/watch.cpp")
        .file("shim/sizes.cpp")
        .file("shim/result.cpp")
        .compile("tetgen_shim");
    println!("cargo:rustc-link-lib=dylib=tet");
}

/// Whether a compiler command succeeds on a source text.
fn accepts(mut command: Command, source: &str) -> bool {
    let child = command
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn();
    let Ok(mut child) = child else {
        fail("no C++ compiler could be started (install g++)");
    };
    if let Some(mut stdin) = child.stdin.take() {
        // A compiler that stops reading early reports by its exit status.
        let _ = stdin.write_all(source.as_bytes());
    }
    child.wait().is_ok_and(|status| status.success())
}

fn fail(what: &str) -> ! {
    eprintln!("tetgen-sys: {what}; {HINT}");
    std::process::exit(1)
}
