//! Where a validation error is, when naga says less than could be known: it names the place where an operand was
//! declared, not the statement that uses it, or no place at all.

use std::ops::Range;

use naga::valid::{CallError, FunctionError, ValidationError};
use naga::{Block, Expression, Handle, Module, Span, Statement};

/// The statement that an error is about, where that can be told.
pub fn of(error: &ValidationError, module: &Module) -> Option<Span> {
    match error {
        ValidationError::Function { handle, source, .. } => statement(source, &module.functions[*handle].body),
        ValidationError::EntryPoint { name, source: naga::valid::EntryPointError::Function(source), .. } => {
            let entry = module.entry_points.iter().find(|entry| entry.name == *name)?;
            statement(source, &entry.function.body)
        }
        _ => None,
    }
}

/// The statement that a function's error is about.
fn statement(error: &FunctionError, body: &Block) -> Option<Span> {
    let test: Box<dyn Fn(&Statement) -> bool> = match *error {
        FunctionError::InvalidReturnType { expression: Some(handle), .. } => {
            Box::new(move |statement| matches!(statement, Statement::Return { value: Some(value) } if *value == handle))
        }
        FunctionError::InvalidIfType(handle) => {
            Box::new(move |statement| matches!(statement, Statement::If { condition, .. } if *condition == handle))
        }
        FunctionError::InvalidSwitchType(handle) => {
            Box::new(move |statement| matches!(statement, Statement::Switch { selector, .. } if *selector == handle))
        }
        FunctionError::InvalidStoreTypes { pointer: to, value: from } => Box::new(
            move |statement| matches!(statement, Statement::Store { pointer, value } if (*pointer, *value) == (to, from)),
        ),
        FunctionError::InvalidCall { function: callee, ref error } => {
            let wanted = match error {
                CallError::ArgumentType { index, seen_expression, .. } => Some((*index, *seen_expression)),
                _ => None,
            };
            Box::new(move |statement| match statement {
                Statement::Call { function, arguments, .. } => *function == callee && passes(arguments, wanted),
                _ => false,
            })
        }
        _ => return None,
    };
    find(body, &*test)
}

fn passes(arguments: &[Handle<Expression>], wanted: Option<(usize, Handle<Expression>)>) -> bool {
    wanted.is_none_or(|(index, handle)| arguments.get(index) == Some(&handle))
}

/// The first statement that passes a test, outer before inner.
fn find(block: &Block, test: &dyn Fn(&Statement) -> bool) -> Option<Span> {
    block.span_iter().find_map(|(statement, span)| {
        if test(statement) {
            return Some(*span);
        }
        match statement {
            Statement::Block(inner) => find(inner, test),
            Statement::If { accept, reject, .. } => find(accept, test).or_else(|| find(reject, test)),
            Statement::Switch { cases, .. } => cases.iter().find_map(|case| find(&case.body, test)),
            Statement::Loop { body, continuing, .. } => find(body, test).or_else(|| find(continuing, test)),
            _ => None,
        }
    })
}

/// The place of an error that has no span in naga, looked for in the text: the name of what it is about, or the type
/// that it quotes. The end of the text, which is the module that was asked for, if all fails.
pub fn in_text(error: &ValidationError, text: &str) -> Range<usize> {
    let found = match error {
        ValidationError::EntryPoint { name, .. } | ValidationError::Function { name, .. } => {
            let declaration = format!("fn {name}");
            word(text, &declaration).map(|range| range.start + 3..range.end)
        }
        ValidationError::Type { source, .. } => {
            let message = source.to_string();
            message.split('`').nth(1).and_then(|quoted| word(text, quoted))
        }
        _ => None,
    };
    found.unwrap_or(text.len()..text.len())
}

/// The first place of a word in a text.
fn word(text: &str, word: &str) -> Option<Range<usize>> {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    text.match_indices(word)
        .map(|(start, found)| start..start + found.len())
        .find(|range| !text[..range.start].ends_with(is_part) && !text[range.end..].starts_with(is_part))
}
