//! `lucerna check --materials`: what becomes of every statement of every material.

use std::path::PathBuf;

use serde_json::{Value, json};

use crate::app::shared::failure::show;
use crate::app::shared::output;
use crate::app::variants::find::find as find_variants;
use crate::app::{Exit, Failure};
use crate::scene::{self, Audit, Audited, Diagnostic, Fate, Severity, Verdict, audits};

/// Prints the materials of files, or of scenes and families by their names, as a table or as one JSON object.
pub fn run(paths: &[PathBuf], as_json: bool) -> Result<Exit, Failure> {
    let mut all: Vec<Audit> = Vec::new();
    for path in paths {
        let name = path.to_string_lossy();
        let file = scene::find(&name).or_else(|error| find_variants(&name).map_err(|_| error))?;
        all.extend(audits(&file));
    }
    let messages = || all.iter().flat_map(|audit| &audit.diagnostics.list);
    messages().for_each(|diagnostic| show(diagnostic));
    let errors = messages().filter(|diagnostic| diagnostic.severity == Severity::Error).count();
    let text = match as_json {
        true => {
            let files: Vec<Value> = all.iter().map(file_of).collect();
            format!("{:#}\n", json!({ "files": files, "errors": errors, "warnings": messages().count() - errors }))
        }
        false => all.iter().map(rendered).collect::<Vec<_>>().join("\n"),
    };
    output::print(&text)?;
    Ok(if errors == 0 { Exit::Done } else { Exit::Failed })
}

/// The word of a fate.
fn word(fate: Fate) -> &'static str {
    match fate {
        Fate::Honoured => "honoured",
        Fate::Approximated => "approximated",
        Fate::Ignored => "ignored",
    }
}

fn file_of(audit: &Audit) -> Value {
    let statement = |verdict: &Verdict| {
        json!({
            "statement": verdict.statement, "file": verdict.place.file.to_string_lossy(), "line": verdict.place.line,
            "column": verdict.place.column, "fate": word(verdict.fate), "why": verdict.why,
        })
    };
    let edit = |(field, place): &(String, Diagnostic)| {
        let file = place.file.to_string_lossy();
        json!({ "field": field, "file": file, "line": place.line, "column": place.column })
    };
    let material = |audited: &Audited| {
        json!({
            "name": audited.name,
            "kind": audited.look.kind,
            "reason": audited.look.reason,
            "library": audited.library.as_ref().map(|library| library.to_string_lossy()),
            "energy": { "written": audited.energy[0], "rendered": audited.energy[1] },
            "policies": audited.policies,
            "statements": audited.statements.iter().map(statement).collect::<Vec<_>>(),
            "edits": audited.edits.iter().map(edit).collect::<Vec<_>>(),
        })
    };
    let materials: Vec<Value> = audit.materials.iter().map(material).collect();
    json!({ "file": audit.file.to_string_lossy(), "members": audit.members, "materials": materials })
}

/// A file's materials: a heading each, its statements below, a line each.
fn rendered(audit: &Audit) -> String {
    let mut text = match &audit.members[..] {
        [] => format!("{}\n", audit.file.display()),
        members => format!("{}: {}\n", audit.file.display(), members.join(", ")),
    };
    for audited in &audit.materials {
        text += &heading(audited);
        let width = |of: fn(&Verdict) -> usize| audited.statements.iter().map(of).max().unwrap_or_default().min(44);
        let statements = width(|verdict| verdict.statement.chars().count());
        for verdict in &audited.statements {
            let Verdict { statement, place, fate, why } = verdict;
            let place = format!("{}:{}", place.file.display(), place.line);
            let line = format!("    {statement:statements$}  {:12}  {place}  {why}", word(*fate));
            text += line.trim_end();
            text += "\n";
        }
        for (field, place) in &audited.edits {
            text += &format!("    {field}: given by {}:{}\n", place.file.display(), place.line);
        }
    }
    text
}

/// The name of a material, what it is, what it reflects, and by which policies.
fn heading(audited: &Audited) -> String {
    let Audited { name, look, energy: [written, rendered], .. } = audited;
    let name = scene::printable_name(name);
    let mut text = format!("\n  {name}: {}, {}\n", look.kind, look.reason);
    let after = if written == rendered { String::new() } else { format!(", rendered {rendered:.3}") };
    text += &format!("    kd + ks {written:.3}{after}\n");
    if audited.library.is_none() {
        text += "    of no library\n";
    }
    for policy in &audited.policies {
        text += &format!("    {policy}\n");
    }
    text
}
