//! What a tool says on standard error: sentences for people, or objects for scripts.

use clap::ValueEnum;
use serde_json::json;
use std::ffi::OsString;
use std::io::{self, Write};

/// Form of the messages on standard error.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum MessageFormat {
    /// `tool: sentence`
    #[default]
    Text,
    /// A JSON object per line, with `tool`, `level` (`error`, `note`, `info`, `detail`), `message`, and
    /// `code`, the exit code, of errors
    Json,
}

/// How much a message matters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Level {
    /// Why the tool stops, with the exit code.
    Error(u8),
    /// What the user should know.
    Note,
    /// What is being done, with the seconds since the start.
    Info(f64),
    /// Details of it.
    Detail,
}

impl MessageFormat {
    /// What a command line asks for, be it well-formed otherwise or not.
    pub(crate) fn sought(arguments: &[OsString]) -> Self {
        let mut json = false;
        let mut before: Option<&str> = None;
        for argument in arguments.iter().skip(1) {
            let word = argument.to_str();
            let value = match (before, word) {
                (_, Some("--")) => break,
                (Some("--message-format"), value) => value,
                (_, Some(word)) => word.strip_prefix("--message-format="),
                _ => None,
            };
            if let Some(value) = value {
                json = value == "json";
            }
            before = word;
        }
        if json { Self::Json } else { Self::Text }
    }

    /// One message, without the line end.
    pub(crate) fn line(self, tool: &str, level: Level, text: &str) -> String {
        if self == Self::Text {
            return match level {
                Level::Error(_) => format!("{tool}: error: {text}"),
                Level::Info(seconds) => format!("{tool}: [{seconds:8.3} s] {text}"),
                Level::Note | Level::Detail => format!("{tool}: {text}"),
            };
        }
        let name = match level {
            Level::Error(_) => "error",
            Level::Note => "note",
            Level::Info(_) => "info",
            Level::Detail => "detail",
        };
        let mut object = json!({"tool": tool, "level": name, "message": text});
        match level {
            Level::Error(code) => object["code"] = code.into(),
            // The same digits as in text.
            Level::Info(seconds) => {
                object["seconds"] = format!("{seconds:.3}").parse().unwrap_or(seconds).into()
            }
            Level::Note | Level::Detail => {}
        }
        object.to_string()
    }
}

/// Writes a line to standard error. A failure to write it is ignored: there is no other place to report it.
pub(crate) fn say(line: &str) {
    // One write per line, so that the lines of the tools of a pipe do not mix.
    let _ = io::stderr().write_all(format!("{line}\n").as_bytes());
}

/// The sentence of clap's message about a mistake on the command line: its first paragraph, without
/// the prefix and the layout.
pub(crate) fn usage_sentence(error: &clap::Error) -> String {
    let text = error.render().to_string();
    let text = text.strip_prefix("error: ").unwrap_or(&text);
    let lines = text.lines().take_while(|line| !line.trim().is_empty());
    let words = lines.flat_map(str::split_whitespace);
    words.collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn objects_hold_what_the_text_says() {
        let line = |level| MessageFormat::Json.line("wedgecut", level, "a \"b\"\nc");
        assert_eq!(
            serde_json::from_str::<serde_json::Value>(&line(Level::Error(3))).unwrap(),
            json!({
                "tool": "wedgecut", "level": "error", "code": 3, "message": "a \"b\"\nc",
            })
        );
        assert!(!line(Level::Note).contains('\n'));
        assert!(line(Level::Info(0.123_456)).contains("0.123,"));
        let text = MessageFormat::Text.line("wedgecut", Level::Error(3), "broken");
        assert_eq!(text, "wedgecut: error: broken");
    }

    #[test]
    fn the_form_is_known_before_the_command_line_is() {
        let sought = |words: &[&str]| {
            let words: Vec<OsString> = words.iter().map(OsString::from).collect();
            MessageFormat::sought(&words)
        };
        let json = MessageFormat::Json;
        assert_eq!(sought(&["t", "--odd", "--message-format", "json"]), json);
        assert_eq!(sought(&["t", "--message-format=json", "--odd"]), json);
        for words in [
            &["t", "--message-format", "text"][..],
            &["t", "--message-format"],
            &["t", "--", "--message-format=json"],
            &["--message-format=json"],
        ] {
            assert_eq!(sought(words), MessageFormat::Text);
        }
    }
}
