//! naga's validation errors in words of the source: no handles, no types of Rust.

use std::error::Error;

use naga::valid::{CallError, EntryPointError, ExpressionError, FunctionError, GlobalVariableError, ValidationError};
use naga::{Arena, Expression, Function, Handle, Module, TypeInner};

use super::types::{type_name, type_text};

/// What a validation error says, for a person who has only the source before them.
pub fn validation(error: &ValidationError, module: &Module, text: &str) -> String {
    match error {
        ValidationError::Function { handle, source, .. } => function(source, module, &module.functions[*handle], text),
        ValidationError::EntryPoint { name, source, .. } => {
            match module.entry_points.iter().find(|e| e.name == *name) {
                Some(entry) => entry_point(source, module, &entry.function, name, text),
                None => chain(source),
            }
        }
        ValidationError::GlobalVariable { name, source: GlobalVariableError::InvalidBinding, .. } => {
            format!("`{name}` wants @group and @binding, and only storage buffers do")
        }
        ValidationError::GlobalVariable { name, source, .. } => format!("`{name}`: {}", types(&chain(source), module)),
        ValidationError::Type { name, source, .. } if name.is_empty() => types(&chain(source), module),
        ValidationError::Type { name, source, .. } => format!("type `{name}`: {}", types(&chain(source), module)),
        ValidationError::Constant { name, source, .. } => format!("constant `{name}`: {}", chain(source)),
        ValidationError::Layouter(error) => {
            format!(
                "`{}` is no type that can be laid out: {}",
                type_text(module, error.ty),
                types(&error.inner.to_string(), module)
            )
        }
        ValidationError::ConstExpression { source, .. } => {
            expressions(&chain(source), &module.global_expressions, text)
        }
        other => expressions(&chain(other), &module.global_expressions, text),
    }
}

fn entry_point(error: &EntryPointError, module: &Module, entry: &Function, name: &str, text: &str) -> String {
    match error {
        EntryPointError::Function(source) => function(source, module, entry, text),
        EntryPointError::BindingCollision(handle) => {
            let variable = &module.global_variables[*handle];
            let at = variable.binding.map_or(String::new(), |b| format!("@group({}) @binding({})", b.group, b.binding));
            let binding = variable.name.as_deref().unwrap_or("_");
            format!("entry point `{name}` uses another variable than `{binding}` at {at} too")
        }
        EntryPointError::InvalidGlobalUsage(handle, usage) => {
            let variable = module.global_variables[*handle].name.as_deref().unwrap_or("_");
            format!("entry point `{name}` uses `{variable}` as {usage:?}, which it was not declared for")
        }
        other => format!("entry point `{name}`: {}", chain(other)),
    }
}

fn function(error: &FunctionError, module: &Module, function: &Function, text: &str) -> String {
    let words = Words { module, function, text };
    match error {
        FunctionError::Expression { source, .. } => words.expression(source),
        FunctionError::InvalidReturnType { expression, expected_ty } => {
            let value = expression.map_or("nothing".to_owned(), |handle| words.code(handle));
            let expected = expected_ty.map_or("no value".to_owned(), |ty| format!("`{}`", type_text(module, ty)));
            format!("this returns {value}, but the function is declared to return {expected}")
        }
        FunctionError::InvalidCall { function: callee, error } => {
            let name = module.functions[*callee].name.as_deref().unwrap_or("_");
            match error {
                CallError::ArgumentType { index, required, seen_expression } => {
                    let required = type_text(module, *required);
                    let seen = words.code(*seen_expression);
                    format!("`{name}` wants `{required}` as argument {}, which {seen} is not", index + 1)
                }
                other => format!("call of `{name}`: {}", words.replace(&chain(other))),
            }
        }
        FunctionError::InvalidStoreTypes { pointer, value } => {
            format!("{} has another type than {}, which it is stored in", words.code(*value), words.code(*pointer))
        }
        FunctionError::InvalidStorePointer(pointer) => format!("{} can't be written", words.code(*pointer)),
        FunctionError::LocalVariable { name, source, .. } => format!("variable `{name}`: {}", chain(source)),
        FunctionError::InvalidArgumentPointerSpace { name, .. } => {
            format!("argument `{name}` points into a space whose pointers can't be passed into functions")
        }
        other => words.replace(&chain(other)),
    }
}

/// A function, to read handles in.
struct Words<'a> {
    module: &'a Module,
    function: &'a Function,
    text: &'a str,
}

impl Words<'_> {
    fn expression(&self, error: &ExpressionError) -> String {
        let name = |inner: &TypeInner| type_name(self.module, inner);
        match error {
            ExpressionError::InvalidBinaryOperandTypes { op, lhs_expr, lhs_type, rhs_expr, rhs_type } => format!(
                "{op:?} can't work with {} ({}) and {} ({})",
                self.code(*lhs_expr),
                name(lhs_type),
                self.code(*rhs_expr),
                name(rhs_type)
            ),
            ExpressionError::SelectValuesTypeMismatch { accept, reject } => {
                format!("the values of this select are of types {} and {}", name(reject), name(accept))
            }
            ExpressionError::SelectConditionNotABool { actual } => {
                format!("the condition of this select is of type {}, not bool", name(actual))
            }
            ExpressionError::ShiftAmountTooLarge { lhs_type, .. } => {
                format!("this shifts by more bits than {} has", name(lhs_type))
            }
            other => self.replace(&chain(other)),
        }
    }

    /// The name of a variable, else the text of an expression, in quotes.
    fn code(&self, handle: Handle<Expression>) -> String {
        let function = self.function;
        let name = match function.expressions[handle] {
            Expression::FunctionArgument(index) => {
                function.arguments.get(index as usize).and_then(|argument| argument.name.clone())
            }
            Expression::LocalVariable(variable) => function.local_variables[variable].name.clone(),
            Expression::GlobalVariable(variable) => self.module.global_variables[variable].name.clone(),
            _ => function.named_expressions.get(&handle).cloned(),
        };
        match name {
            Some(name) => format!("`{name}`"),
            None => snippet(&function.expressions, handle, self.text),
        }
    }

    /// A message with the handles in it, `[3]`, read as expressions of the function.
    fn replace(&self, message: &str) -> String {
        replace_handles(message, |index| {
            self.function.expressions.iter().nth(index).map(|(handle, _)| self.code(handle))
        })
    }
}

/// An error and what caused it, in one line.
fn chain(error: &dyn Error) -> String {
    let mut text = error.to_string();
    let mut next = error.source();
    while let Some(source) = next {
        let more = source.to_string();
        // Transparent errors repeat what they hold.
        if !text.ends_with(&more) {
            text.push_str(": ");
            text.push_str(&more);
        }
        next = source.source();
    }
    text
}

/// The text of an expression in quotes.
fn snippet(arena: &Arena<Expression>, handle: Handle<Expression>, text: &str) -> String {
    let range = arena.get_span(handle).to_range();
    match range.and_then(|range| text.get(range)) {
        Some(code) => {
            let words: Vec<&str> = code.split_whitespace().collect();
            format!("`{}`", words.join(" "))
        }
        None => "this expression".to_owned(),
    }
}

/// A message with the handles in it, `[3]`, read as expressions of an arena.
fn expressions(message: &str, arena: &Arena<Expression>, text: &str) -> String {
    replace_handles(message, |index| arena.iter().nth(index).map(|(handle, _)| snippet(arena, handle, text)))
}

/// A message with the handles in it, `[3]`, read as types.
fn types(message: &str, module: &Module) -> String {
    replace_handles(message, |index| {
        module.types.iter().nth(index).map(|(handle, _)| format!("`{}`", type_text(module, handle)))
    })
}

/// A message of naga's front end without the handles in it: nobody can look those up.
pub fn without_handles(message: &str) -> String {
    replace_handles(&message.replace("for expression [", "for ["), |_| Some("what it is taken of".to_owned()))
}

fn replace_handles(message: &str, name: impl Fn(usize) -> Option<String>) -> String {
    let mut result = String::new();
    let mut rest = message;
    while let Some(open) = rest.find('[') {
        let Some(length) = rest[open..].find(']') else { break };
        let handle = &rest[open + 1..open + length];
        result.push_str(&rest[..open]);
        match handle.parse().ok().and_then(&name) {
            Some(words) => result.push_str(&words),
            None => result.push_str(&rest[open..=open + length]),
        }
        rest = &rest[open + length + 1..];
    }
    result.push_str(rest);
    result
}
