//! Writes the man pages and shell completions of the tools into a folder.
//!
//! ```text
//! cargo run -p manual -- target/manual
//! ```
//!
//! Man pages go to `man1`, completions to `bash`, `zsh` and `fish`, under the names by which those
//! shells look them up.

use clap::{Command, CommandFactory};
use clap_complete::{Shell, generate_to};
use std::path::Path;
use std::process::ExitCode;
use std::{env, fs, io};

fn tools() -> [Command; 6] {
    [
        symdetect::Cli::command(),
        wedgecut::Cli::command(),
        periodic_surf::Cli::command(),
        tetwedge::Cli::command(),
        rotassemble::Cli::command(),
        meshqual::Cli::command(),
    ]
}

/// What all pages say in the end.
const EXIT: &str = ".SH \"EXIT STATUS\"\n0 done; 1 the input is sound but this cannot be done, or a check \
                    failed; 2 wrong usage; 3 the input is malformed, truncated or not a closed surface; 4 the \
                    output could not be written.\n";

fn write_page(command: &Command, names: &[String], folder: &Path) -> io::Result<()> {
    let page = clap_mangen::Man::new(command.clone());
    let mut text = Vec::new();
    page.render_title(&mut text)?;
    page.render_name_section(&mut text)?;
    page.render_synopsis_section(&mut text)?;
    page.render_description_section(&mut text)?;
    page.render_options_section(&mut text)?;
    page.render_extra_section(&mut text)?;
    text.extend(EXIT.as_bytes());
    let others = names.iter().filter(|n| *n != command.get_name());
    let others: Vec<String> = others.map(|n| format!(".BR {n} (1)")).collect();
    text.extend(format!(".SH \"SEE ALSO\"\n{}\n", others.join(",\n")).as_bytes());
    page.render_version_section(&mut text)?;
    fs::write(folder.join(format!("{}.1", command.get_name())), text)
}

fn write(folder: &Path) -> io::Result<()> {
    let man = folder.join("man1");
    fs::create_dir_all(&man)?;
    let names: Vec<String> = tools().iter().map(|c| c.get_name().to_owned()).collect();
    for mut command in tools() {
        write_page(&command, &names, &man)?;
        let name = command.get_name().to_owned();
        for shell in [Shell::Bash, Shell::Zsh, Shell::Fish] {
            let to = folder.join(shell.to_string());
            fs::create_dir_all(&to)?;
            let path = generate_to(shell, &mut command, &name, &to)?;
            if shell == Shell::Bash {
                // Completions are looked up by the name of the command.
                fs::rename(path, to.join(&name))?;
            }
        }
    }
    Ok(())
}

fn main() -> ExitCode {
    let mut arguments = env::args_os().skip(1);
    let (Some(folder), None) = (arguments.next(), arguments.next()) else {
        eprintln!("usage: manual FOLDER");
        return ExitCode::from(2);
    };
    match write(Path::new(&folder)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("manual: cannot write {}: {error}", folder.display());
            ExitCode::from(4)
        }
    }
}
