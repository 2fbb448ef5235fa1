//! Where a validation error is, when naga says less than could be known: it names the place where an operand was
//! declared, not the statement that uses it, or no place at all.

use std::ops::Range;

use naga::valid::{CallError, FunctionError, ValidationError};
use naga::{Block, Expression, Handle, Module, Span, Statement, Type, TypeInner};

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

/// What has the type that an error is about.
pub fn of_type(error: &ValidationError, module: &Module) -> Option<Span> {
    match error {
        ValidationError::Layouter(error) => user_of(error.ty, module),
        _ => None,
    }
}

/// The declaration of a type; of one that has none, a variable, struct, value or function that it stands in.
pub fn user_of(ty: Handle<Type>, module: &Module) -> Option<Span> {
    let known = |span: Span| span.is_defined().then_some(span);
    if let Some(span) = known(module.types.get_span(ty)) {
        return Some(span);
    }
    let globals = module.global_variables.iter().filter(|(_, variable)| variable.ty == ty);
    let global = globals.map(|(handle, _)| module.global_variables.get_span(handle)).find_map(known);
    let entries = module.entry_points.iter().map(|entry| (Span::UNDEFINED, &entry.function));
    let functions = module.functions.iter().map(|(handle, function)| (module.functions.get_span(handle), function));
    let local = functions.chain(entries).find_map(|(span, function)| {
        let variables = function.local_variables.iter().filter(|(_, variable)| variable.ty == ty);
        let values = function.expressions.iter().filter(|(_, value)| match value {
            Expression::ZeroValue(made) | Expression::Compose { ty: made, .. } => *made == ty,
            _ => false,
        });
        let signature = function.arguments.iter().map(|argument| argument.ty);
        let in_signature = signature.chain(function.result.as_ref().map(|result| result.ty)).any(|used| used == ty);
        variables
            .map(|(handle, _)| function.local_variables.get_span(handle))
            .chain(values.map(|(handle, _)| function.expressions.get_span(handle)))
            .find_map(known)
            .or_else(|| known(span).filter(|_| in_signature))
    });
    // Whatever holds it is behind it.
    let holder = || {
        module.types.iter().find(|(_, outer)| match &outer.inner {
            TypeInner::Array { base, .. } | TypeInner::Pointer { base, .. } => *base == ty,
            TypeInner::Struct { members, .. } => members.iter().any(|member| member.ty == ty),
            _ => false,
        })
    };
    global.or(local).or_else(|| holder().and_then(|(outer, _)| user_of(outer, module)))
}

/// The place of an error that has no span in naga, looked for in the text: the name of what it is about, or the type
/// that it quotes.
pub fn in_text(error: &ValidationError, text: &str) -> Option<Range<usize>> {
    match error {
        ValidationError::EntryPoint { name, .. } | ValidationError::Function { name, .. } => {
            let declaration = format!("fn {name}");
            word(text, &declaration).map(|range| range.start + 3..range.end)
        }
        ValidationError::Type { source, .. } => {
            let message = source.to_string();
            message.split('`').nth(1).and_then(|quoted| word(text, quoted))
        }
        _ => None,
    }
}

/// The first place of a word in a text.
fn word(text: &str, word: &str) -> Option<Range<usize>> {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    text.match_indices(word)
        .map(|(start, found)| start..start + found.len())
        .find(|range| !text[..range.start].ends_with(is_part) && !text[range.end..].starts_with(is_part))
}
