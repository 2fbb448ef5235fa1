//! A number that code shows of itself: `probe("mis weight", weight);` as a statement of any function.
//!
//! WGSL has neither texts nor functions of several types. Where somebody listens, the linker puts a function of `lib/probe` in the place of
//! the call, and the name's number in that of the name; everywhere else the whole statement is blanked, its argument included. Which function
//! that is says the type that naga finds: the text is parsed once with a variable in the place of each call.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use naga::{Module, Scalar, TypeInner, VectorSize};

use super::Features;
use super::error::{ErrorKind, Place, ShaderError, Source};
use super::token::{Token, TokenKind};
use super::types::type_text;
use crate::layout::probe::MOST_PROBES;

/// What a call looks like.
const CALL: &str = "probe";

/// What to do about an import of it.
pub const NO_IMPORT: &str = "`probe(\"name\", value);` needs no import";

/// What to do about one that is wrong.
const EXAMPLE: &str = "write it like `probe(\"mis weight\", weight);`, a statement by itself";

/// The features under which somebody listens.
const HEARD: [&str; 2] = ["probe_view", "record"];

/// The one that calls are tried with where nobody does, so that a wrong one is told at once.
pub const TRIED: &str = HEARD[0];

/// The module that is called in the place of the statement, and one of its functions.
pub const CALLED: [&str; 2] = ["lib/probe", "probe_f32"];

/// Characters that a name may have.
const LONGEST: usize = 40;

/// What variables are called whose types are asked for.
const VARIABLE: &str = "probed_value_";

/// A name that code shows numbers by.
#[derive(Clone, Debug)]
pub struct Probe {
    pub name: String,
    /// Of the calls that have it, one at least: in the order of modules.
    pub places: Vec<Place>,
}

/// A statement that shows a number.
#[derive(Clone, Debug)]
pub struct Call {
    pub name: String,
    /// Bytes of the source, up to and with its semicolon.
    pub statement: Range<usize>,
    /// What of it stands before the value.
    pub head: Range<usize>,
    pub value: Range<usize>,
}

/// A [`Call`], and the tokens that it takes.
pub struct Read {
    pub call: Call,
    /// The first of the value.
    pub value: usize,
    /// The one behind the statement.
    pub end: usize,
}

/// Whether calls are heard under some features.
pub fn is_heard(features: &Features) -> bool {
    HEARD.iter().any(|feature| features.contains(*feature))
}

/// Those features: they make a difference to whatever has a call.
pub fn listeners() -> Features {
    HEARD.map(str::to_owned).into()
}

/// Whether a name is that of calls.
pub fn is_call(name: &str) -> bool {
    name == CALL
}

/// Whether a call starts at a token.
pub fn starts(source: &Arc<Source>, tokens: &[Token], at: usize) -> bool {
    let tokens = Tokens { source, tokens };
    let before = at.checked_sub(1).map_or("", |before| tokens.text(before));
    tokens.text(at) == CALL && tokens.text(at + 1) == "(" && !matches!(before, "fn" | ".")
}

/// The call that starts at a token; `in_block` is whether statements stand there.
pub fn read(source: &Arc<Source>, tokens: &[Token], at: usize, in_block: bool) -> Result<Read, ShaderError> {
    let tokens = Tokens { source, tokens };
    tokens.check_statement(at, in_block)?;
    tokens.read(at)
}

/// Refuses a function of that name, which would never be called.
pub fn check_declared(source: &Arc<Source>, kind: &str, name: &Range<usize>) -> Result<(), ShaderError> {
    if kind != "fn" || source.text[name.clone()] != *CALL {
        return Ok(());
    }
    let message = format!("`{CALL}` shows a number of the code it stands in: a function wants another name");
    Err(ShaderError::at(ErrorKind::Probe, source, name.clone(), message).help("give it one that nothing else has"))
}

/// Adds the names of a module's calls, whatever features they stand under. What is wrong is left to linking.
pub fn add_names(source: &Arc<Source>, tokens: &[Token], names: &mut BTreeMap<String, Probe>) {
    let calls = (0..tokens.len()).filter(|at| starts(source, tokens, *at));
    for Read { call, .. } in calls.filter_map(|at| Tokens { source, tokens }.read(at).ok()) {
        let place = Place::new(source.clone(), call.statement);
        let probe = Probe { name: call.name.clone(), places: Vec::new() };
        names.entry(call.name).or_insert(probe).places.push(place);
    }
}

/// Refuses more names than a list can show: at the first call of the first name that is too much.
pub fn check_number(names: &[Probe]) -> Result<(), ShaderError> {
    let Some(probe) = names.get(MOST_PROBES as usize) else { return Ok(()) };
    let message = format!("`{}` is one of {} names of probes: there may be {MOST_PROBES}", probe.name, names.len());
    Err(ShaderError::of(ErrorKind::Probe, probe.places[0].clone(), message)
        .help("take out those that are no longer looked at; several calls may share a name"))
}

/// What stands before the value of call `index` where its type is asked for; the parenthesis that closes the call closes this.
pub fn asking(index: usize) -> String {
    format!("var {VARIABLE}{index} = (")
}

/// What stands before the value where the call is heard.
pub fn calling(function: &str, number: usize) -> String {
    format!("{function}({number}u, ")
}

/// The functions of `lib/probe` that calls come to, by what naga made of the variables in their places; for one whose value has none, its type.
pub fn functions(module: &Module, count: usize) -> Vec<Result<&'static str, String>> {
    let mut found = vec![Err("of no type".to_owned()); count];
    let entries = module.entry_points.iter().map(|entry| &entry.function);
    let functions = module.functions.iter().map(|(_, function)| function).chain(entries);
    for (_, variable) in functions.flat_map(|function| function.local_variables.iter()) {
        let index = variable.name.as_ref().and_then(|name| name.strip_prefix(VARIABLE)?.parse::<usize>().ok());
        if let Some(slot) = index.and_then(|index| found.get_mut(index)) {
            *slot = function_of(&module.types[variable.ty].inner).ok_or_else(|| type_text(module, variable.ty));
        }
    }
    found
}

fn function_of(inner: &TypeInner) -> Option<&'static str> {
    Some(match *inner {
        TypeInner::Scalar(Scalar::F32) => "probe_f32",
        TypeInner::Scalar(Scalar::U32) => "probe_u32",
        TypeInner::Scalar(Scalar::BOOL) => "probe_bool",
        TypeInner::Vector { size: VectorSize::Bi, scalar: Scalar::F32 } => "probe_vec2f",
        TypeInner::Vector { size: VectorSize::Tri, scalar: Scalar::F32 } => "probe_vec3f",
        _ => return None,
    })
}

/// Why a value of a type is shown by no function.
pub fn unknown_type(source: &Arc<Source>, call: &Call, ty: &str) -> ShaderError {
    let message = format!("`{CALL}` shows f32, vec2f, vec3f, u32 or bool, and this is {ty}");
    let help = match ty {
        "i32" => "write f32(..) or u32(..) around it",
        _ => "show a part of it: a member, `.xyz`, or f32(..) of one",
    };
    ShaderError::at(ErrorKind::Probe, source, call.value.clone(), message).help(help)
}

/// The tokens of a module.
struct Tokens<'a> {
    source: &'a Arc<Source>,
    tokens: &'a [Token],
}

impl<'a> Tokens<'a> {
    fn text(&self, at: usize) -> &'a str {
        self.tokens.get(at).map_or("", |token| &self.source.text[token.range.clone()])
    }

    fn range(&self, at: usize) -> Range<usize> {
        let end = self.source.text.len();
        self.tokens.get(at).map_or(end..end, |token| token.range.clone())
    }

    fn error(&self, at: usize, message: impl Into<String>) -> ShaderError {
        ShaderError::at(ErrorKind::Probe, self.source, self.range(at), message).help(EXAMPLE)
    }

    /// Refuses a call where a value stands.
    fn check_statement(&self, at: usize, in_block: bool) -> Result<(), ShaderError> {
        let begins = at.checked_sub(1).is_none_or(|before| matches!(self.text(before), "{" | "}" | ";"));
        match in_block && begins {
            true => Ok(()),
            false => Err(self.error(at, format!("`{CALL}` is a statement by itself, and has no value"))),
        }
    }

    fn read(&self, at: usize) -> Result<Read, ShaderError> {
        let name = self.name(at + 2)?;
        if self.text(at + 3) != "," {
            return Err(self.error(at + 3, format!("`{CALL}` wants a comma and a value behind the name")));
        }
        let close = self.close(at + 1).ok_or_else(|| self.error(at + 1, "this `(` is never closed"))?;
        if close <= at + 4 {
            return Err(self.error(close, format!("`{CALL}` wants a value behind the name")));
        }
        if self.text(close + 1) != ";" {
            return Err(self.error(close + 1, format!("`{CALL}` is a statement by itself: it wants a `;` here")));
        }
        let (start, value) = (self.range(at).start, self.range(at + 4).start..self.range(close - 1).end);
        let statement = start..self.range(close + 1).end;
        Ok(Read { call: Call { name, statement, head: start..value.start, value }, value: at + 4, end: close + 2 })
    }

    /// The name that stands at a token.
    fn name(&self, at: usize) -> Result<String, ShaderError> {
        let is_text = self.tokens.get(at).is_some_and(|token| token.kind == TokenKind::Text);
        if !is_text {
            return Err(self.error(at, format!("`{CALL}` wants a name in quotes here, as it is written: a literal")));
        }
        let name = self.text(at).trim_matches('"');
        let fits = |c: char| !c.is_control() && c != '\\';
        if name.trim().is_empty() || name.chars().count() > LONGEST || !name.chars().all(fits) {
            let message = format!("the name of a probe has 1 to {LONGEST} characters, and no `\\`");
            return Err(self.error(at, message));
        }
        Ok(name.to_owned())
    }

    /// The parenthesis that closes the one at a token.
    fn close(&self, open: usize) -> Option<usize> {
        let mut depth = 0;
        (open..self.tokens.len()).find(|at| {
            match self.text(*at) {
                "(" | "[" | "{" => depth += 1,
                ")" | "]" | "}" => depth -= 1,
                _ => {}
            }
            depth == 0
        })
    }
}
