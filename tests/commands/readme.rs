//! The script that runs what README shows.

use std::path::Path;
use std::process::{Command, Output};

/// Runs the script on a file; nothing where there is no Python.
fn script(what: &str, file: &Path) -> Option<Output> {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/.ci/readme");
    let binaries = Path::new(env!("CARGO_BIN_EXE_symdetect")).parent();
    let output = Command::new("python3")
        .args([script, what])
        .arg(file)
        .arg("--binaries")
        .arg(binaries.expect("a folder"))
        .output();
    if output.is_err() {
        println!("skipped: there is no python3");
    }
    output.ok()
}

#[test]
fn figures_that_are_not_printed_are_found_and_replaced() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("README.md");
    let shown = |count: &str| {
        format!(
            "text\n\n```\n$ meshqual --version > version.txt\n$ printf 'of %s\\n' 3 7; echo 'in 4.5 s'; wc -l < \
             version.txt\nof 3\n...\nin 0.12 s\n{count}\n```\n\n```\nnot $ run\n```\n"
        )
    };
    let put = |text: &str| std::fs::write(&file, text).expect("it can be written");
    // Another time is no difference.
    put(&shown("1"));
    let Some(right) = script("check", &file) else {
        return;
    };
    assert!(right.status.success(), "{right:?}");
    put(&shown("2"));
    let Some(wrong) = script("check", &file) else {
        return;
    };
    let text = String::from_utf8_lossy(&wrong.stderr);
    assert_eq!(wrong.status.code(), Some(1), "{text}");
    assert!(text.contains("\n-2\n+1\n"), "{text}");
    script("update", &file);
    let now = std::fs::read_to_string(&file).expect("it is there");
    assert_eq!(now, shown("1"));
}

#[test]
fn files_that_are_not_there_are_found() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("README.md");
    let text = "[a](lost.md) `examples/flows/lost.mk` `make -f gear.mk`\n\n```\n$ meshqual lost.tmesh\n```\n";
    std::fs::write(&file, text).expect("it can be written");
    let Some(wrong) = script("check", &file) else {
        return;
    };
    let text = String::from_utf8_lossy(&wrong.stderr);
    for part in [
        "the link to lost.md leads nowhere",
        "there is no examples/flows/lost.mk",
        "gear.mk is named without its path",
        "exit status 3: $ meshqual lost.tmesh",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
}
