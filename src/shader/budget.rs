//! Loops with an end: what an edited shader gets, so that a loop without one can't take the device with it.
//!
//! All loops of one invocation together count down one number. Where it is used up, the loop is left, and every other one
//! at its next round. The buffer [`LOOP_FAULTS`] tells how many invocations came to that, and the last loop they were in.
//! naga's own loop bounding counts each loop to 2^64, which stops nothing.

use naga::{
    AddressSpace, Arena, ArraySize, AtomicFunction, BinaryOperator, Block, Expression, GlobalVariable, Handle, Literal,
    MemoryDecorations, Module, Range, ResourceBinding, Scalar, Span, Statement, StorageAccess, Type, TypeInner,
};

/// The name of the added buffer: two words, the number of invocations, and 1 + the number of the loop.
pub const LOOP_FAULTS: &str = "loop_faults";

/// What the added statements refer to.
struct Added {
    /// Rounds that are left to the invocation.
    left: Handle<GlobalVariable>,
    faults: Handle<GlobalVariable>,
    /// Number of the first loop.
    first: u32,
}

/// Gives every loop of a module its end after `rounds` rounds of all loops of an invocation. Returns where the loops are,
/// in the order of their numbers, of which the first is `first`.
pub fn limit_loops(module: &mut Module, rounds: u32, first: u32) -> Vec<Span> {
    let added = declare(module, rounds, first);
    let mut spans = Vec::new();
    let entries = module.entry_points.iter_mut().map(|entry| &mut entry.function);
    for function in module.functions.iter_mut().map(|(_, function)| function).chain(entries) {
        visit(&mut function.body, &mut function.expressions, &added, &mut spans);
    }
    spans
}

fn declare(module: &mut Module, rounds: u32, first: u32) -> Added {
    let mut named = |inner| module.types.insert(Type { name: None, inner }, Span::UNDEFINED);
    let word = named(TypeInner::Scalar(Scalar::U32));
    let atomic = named(TypeInner::Atomic(Scalar::U32));
    let size = ArraySize::Constant(std::num::NonZeroU32::MIN.saturating_add(1));
    let pair = named(TypeInner::Array { base: atomic, size, stride: 4 });
    let init = module.global_expressions.append(Expression::Literal(Literal::U32(rounds)), Span::UNDEFINED);
    let bound = module.global_variables.iter().filter_map(|(_, variable)| variable.binding);
    let free = bound.map(|binding| binding.binding + 1).max().unwrap_or(0);
    let mut add = |name: &str, space, binding, ty, init| {
        let name = Some(name.to_owned());
        let memory_decorations = MemoryDecorations::empty();
        let variable = GlobalVariable { name, space, binding, ty, init, memory_decorations };
        module.global_variables.append(variable, Span::UNDEFINED)
    };
    let access = StorageAccess::LOAD | StorageAccess::STORE;
    let binding = Some(ResourceBinding { group: 0, binding: free });
    Added {
        first,
        left: add("loop_rounds", AddressSpace::Private, None, word, Some(init)),
        faults: add(LOOP_FAULTS, AddressSpace::Storage { access }, binding, pair, None),
    }
}

/// Puts the count at the head of every loop below a block, outer loops first.
fn visit(block: &mut Block, expressions: &mut Arena<Expression>, added: &Added, spans: &mut Vec<Span>) {
    for (statement, span) in block.span_iter_mut() {
        match statement {
            Statement::Block(inner) => visit(inner, expressions, added, spans),
            Statement::If { accept, reject, .. } => {
                visit(accept, expressions, added, spans);
                visit(reject, expressions, added, spans);
            }
            Statement::Switch { cases, .. } => {
                cases.iter_mut().for_each(|case| visit(&mut case.body, expressions, added, spans));
            }
            Statement::Loop { body, continuing, .. } => {
                let number = added.first + spans.len() as u32;
                spans.push(span.map_or(Span::UNDEFINED, |span| *span));
                let head = count_down(expressions, added, number + 1);
                visit(body, expressions, added, spans);
                visit(continuing, expressions, added, spans);
                body.splice(0..0, head);
            }
            _ => {}
        }
    }
}

/// `if left == 0 { break; } left -= 1; if left == 0 { faults[0] += 1; faults[1] = max(faults[1], number); break; }`
fn count_down(expressions: &mut Arena<Expression>, added: &Added, number: u32) -> Block {
    let mut add = |expression| expressions.append(expression, Span::UNDEFINED);
    let pointer = add(Expression::GlobalVariable(added.left));
    let faults = add(Expression::GlobalVariable(added.faults));
    let [zero, one, number] = [0, 1, number].map(|n| add(Expression::Literal(Literal::U32(n))));
    let left = add(Expression::Load { pointer });
    let less = add(Expression::Binary { op: BinaryOperator::Subtract, left, right: one });
    let none = add(Expression::Binary { op: BinaryOperator::Equal, left, right: zero });
    let last = add(Expression::Binary { op: BinaryOperator::Equal, left, right: one });
    let count = add(Expression::AccessIndex { base: faults, index: 0 });
    let place = add(Expression::AccessIndex { base: faults, index: 1 });

    let block = |statements: Vec<Statement>| Block::from_vec(statements);
    let atomic = |pointer, fun, value| Statement::Atomic { pointer, fun, value, result: None };
    let tell = block(vec![
        Statement::Emit(Range::new_from_bounds(count, place)),
        atomic(count, AtomicFunction::Add, one),
        atomic(place, AtomicFunction::Max, number),
        Statement::Break,
    ]);
    block(vec![
        Statement::Emit(Range::new_from_bounds(left, last)),
        Statement::If { condition: none, accept: block(vec![Statement::Break]), reject: Block::new() },
        Statement::Store { pointer, value: less },
        Statement::If { condition: last, accept: tell, reject: Block::new() },
    ])
}
