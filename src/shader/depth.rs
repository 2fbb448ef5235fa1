//! How deep a shader may nest, checked before anything recurses over it.
//!
//! naga's front end, its backends and the compilers of drivers recurse over what they read, and a stack that overflows ends
//! the program. naga refuses by itself, without a place, what nests 200 brackets; it does not count operators.

use std::ops::Range;
use std::sync::Arc;

use naga::{Module, Statement, TypeInner};

use super::error::{ErrorKind, ShaderError, Source};
use super::site;
use super::token::{Token, TokenKind};

/// Brackets within brackets, blocks and lists of types included. naga takes 127 blocks.
const BRACKETS: usize = 100;

/// Operators of one expression, from the outermost to the innermost; and the `else` of one `if`.
const OPERATORS: usize = 1000;

/// Declarations of all modules that are linked together: naga orders them by recursion.
pub const DECLARATIONS: usize = 20_000;

/// Types within types, and functions that call functions. Drivers inline every call.
const NAMED: usize = 200;

/// What may hold types in `<` and `>`.
const GENERIC: [&str; 14] = [
    "array",
    "atomic",
    "binding_array",
    "bitcast",
    "ptr",
    "var",
    "vec2",
    "vec3",
    "vec4",
    "mat2x2",
    "mat3x3",
    "mat4x4",
    "mat3x4",
    "mat4x3",
];

/// An open bracket, and what stands in it since the last comma or semicolon.
struct Level<'a> {
    closing: &'a str,
    /// Operators between operands.
    chain: usize,
    /// Signs before the last operand; members and indices behind it.
    run: usize,
    /// `else` of an `if` that goes on.
    branches: usize,
}

impl Level<'_> {
    fn depth(&self) -> usize {
        self.chain + self.run + self.branches
    }
}

/// Goes through the tokens of a module, whose brackets match.
struct Depth<'a> {
    levels: Vec<Level<'a>>,
    /// Of all levels together.
    operators: usize,
}

impl<'a> Depth<'a> {
    fn innermost(&mut self, change: impl FnOnce(&mut Level<'a>)) {
        if let Some(level) = self.levels.last_mut() {
            self.operators -= level.depth();
            change(level);
            self.operators += level.depth();
        }
    }

    fn open(&mut self, closing: &'a str) {
        self.levels.push(Level { closing, chain: 0, run: 0, branches: 0 });
    }

    /// Leaves a bracket, and whatever looked like a list of types in it.
    fn close(&mut self, closing: &str) {
        while self.levels.len() > 1 {
            let level = self.levels.pop().expect("invariant: there are two");
            self.operators -= level.depth();
            if level.closing == closing {
                return;
            }
        }
    }

    fn end_expression(&mut self) {
        self.innermost(|level| (level.chain, level.run) = (0, 0));
    }

    /// Takes a sign, the token before it and whether that ends an operand, and the token behind it.
    fn take(&mut self, sign: &str, (before, operand): (&str, bool), behind: &str) {
        let in_types = self.levels.last().is_some_and(|level| level.closing == ">");
        match sign {
            "(" | "[" => {
                self.innermost(|level| level.run += usize::from(operand));
                self.open(if sign == "(" { ")" } else { "]" });
            }
            "{" => {
                self.end_expression();
                self.open("}");
            }
            "<" if GENERIC.contains(&before) => self.open(">"),
            ">" if in_types => self.close(sign),
            ")" | "]" => self.close(sign),
            "}" => {
                self.close(sign);
                self.innermost(|level| level.branches = if behind == "else" { level.branches + 1 } else { 0 });
                self.end_expression();
            }
            ";" => {
                // What looked like a list of types was a comparison.
                while self.levels.last().is_some_and(|level| level.closing == ">") {
                    self.close(">");
                }
                self.end_expression();
            }
            "," => self.end_expression(),
            "." => self.innermost(|level| level.run += 1),
            "@" | ":" => {}
            _ => self.innermost(|level| match operand {
                true => (level.chain, level.run) = (level.chain + 1, 0),
                false => level.run += 1,
            }),
        }
    }

    /// What is too deep by now, and what to do about it.
    fn refusal(&self) -> Option<(String, &'static str)> {
        if self.levels.len() > BRACKETS + 1 {
            let help = "name a part by `let`, or make it a function of its own";
            return Some((format!("this is nested more than {BRACKETS} brackets deep"), help));
        }
        if self.operators <= OPERATORS {
            return None;
        }
        Some(match self.levels.iter().any(|level| level.branches > OPERATORS / 2) {
            true => (
                format!("this `if` has more than {OPERATORS} branches and operators"),
                "use `switch`, or a table in an array",
            ),
            false => (
                format!("this expression has more than {OPERATORS} operators that wait for each other"),
                "name parts of it by `let`, or add them up in a loop over an array",
            ),
        })
    }
}

/// Refuses what nests deeper than a stack carries, at the token that is too deep.
pub fn check_tokens(source: &Arc<Source>, tokens: &[Token]) -> Result<(), ShaderError> {
    let text = |i: usize| tokens.get(i).map_or("", |token| &source.text[token.range.clone()]);
    let mut depth = Depth { levels: Vec::new(), operators: 0 };
    depth.open("");
    let (mut before, mut operand) = ("", false);
    for (i, token) in tokens.iter().enumerate() {
        let sign = text(i);
        if token.kind == TokenKind::Sign {
            depth.take(sign, (before, operand), text(i + 1));
        }
        if let Some((message, help)) = depth.refusal() {
            return Err(ShaderError::at(ErrorKind::Syntax, source, token.range.clone(), message).help(help));
        }
        before = sign;
        operand = token.kind != TokenKind::Sign || matches!(sign, ")" | "]" | ">");
    }
    Ok(())
}

/// What of a parsed module is too deep for those who compile it: types within types, functions that call functions.
/// Returns where, and in what words.
pub fn check_module(module: &Module) -> Option<(Option<Range<usize>>, String)> {
    let mut types = vec![0; module.types.len()];
    for (handle, ty) in module.types.iter() {
        let inner: usize = match &ty.inner {
            TypeInner::Array { base, .. } | TypeInner::BindingArray { base, .. } | TypeInner::Pointer { base, .. } => {
                types[base.index()]
            }
            TypeInner::Struct { members, .. } => {
                members.iter().map(|member| types[member.ty.index()]).max().unwrap_or(0)
            }
            _ => continue,
        };
        types[handle.index()] = inner + 1;
        if inner == NAMED {
            let range = site::user_of(handle, module).and_then(|span| span.to_range());
            return Some((range, format!("types are nested more than {NAMED} deep")));
        }
    }
    // naga has put every function behind those that it calls.
    let mut calls = vec![0; module.functions.len()];
    for (handle, function) in module.functions.iter() {
        let mut deepest = 0;
        visit(&function.body, &mut |statement| {
            if let Statement::Call { function, .. } = statement {
                deepest = deepest.max(1 + calls[function.index()]);
            }
        });
        calls[handle.index()] = deepest;
        if deepest > NAMED {
            let range = module.functions.get_span(handle).to_range();
            return Some((range, format!("more than {NAMED} functions call each other in turn")));
        }
    }
    None
}

fn visit(block: &naga::Block, test: &mut impl FnMut(&Statement)) {
    for statement in block {
        test(statement);
        match statement {
            Statement::Block(inner) => visit(inner, test),
            Statement::If { accept, reject, .. } => {
                visit(accept, test);
                visit(reject, test);
            }
            Statement::Switch { cases, .. } => cases.iter().for_each(|case| visit(&case.body, test)),
            Statement::Loop { body, continuing, .. } => {
                visit(body, test);
                visit(continuing, test);
            }
            _ => {}
        }
    }
}
