//! Loops with an end: what an edited shader gets, so that a loop without one can't take the device with it.
//!
//! All loops of one invocation together count their rounds. From some number on, every loop is left at the end of its round. The
//! buffer [`LOOP_FAULTS`] tells how many invocations came to that, and the last loop in which one did. naga's own loop
//! bounding counts each loop to 2^64, which stops nothing.
//!
//! Loops are left at their ends, and the buffer is written once, where the entry point returns: an early way out of each
//! loop, and atomics there, took lavapipe longer to compile.

use naga::proc::ensure_block_returns;
use naga::{
    AddressSpace, Arena, ArraySize, AtomicFunction, BinaryOperator, Block, Expression, Function, GlobalVariable,
    Handle, Literal, MemoryDecorations, Module, Range, ResourceBinding, Scalar, Span, Statement, StorageAccess, Type,
    TypeInner,
};

/// The name of the added buffer: two words, the number of invocations, and 1 + the number of the loop.
pub const LOOP_FAULTS: &str = "loop_faults";

/// What the added statements refer to.
struct Added {
    /// Rounds of the invocation so far.
    rounds: Handle<GlobalVariable>,
    /// Rounds that it may take.
    most: u32,
    /// 1 + the number of the loop in which it took them all; 0 before that.
    ended: Handle<GlobalVariable>,
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
    if !spans.is_empty() {
        for Function { body, expressions, .. } in module.entry_points.iter_mut().map(|entry| &mut entry.function) {
            ensure_block_returns(body);
            tell_at_returns(body, expressions, &added, &mut false);
        }
    }
    spans
}

fn declare(module: &mut Module, rounds: u32, first: u32) -> Added {
    let mut named = |inner| module.types.insert(Type { name: None, inner }, Span::UNDEFINED);
    let word = named(TypeInner::Scalar(Scalar::U32));
    let atomic = named(TypeInner::Atomic(Scalar::U32));
    let size = ArraySize::Constant(std::num::NonZeroU32::MIN.saturating_add(1));
    let pair = named(TypeInner::Array { base: atomic, size, stride: 4 });
    let zero = module.global_expressions.append(Expression::Literal(Literal::U32(0)), Span::UNDEFINED);
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
        most: rounds,
        rounds: add("loop_rounds", AddressSpace::Private, None, word, Some(zero)),
        ended: add("loop_ended", AddressSpace::Private, None, word, Some(zero)),
        faults: add(LOOP_FAULTS, AddressSpace::Storage { access }, binding, pair, None),
    }
}

/// Puts the count at the end of every loop below a block, outer loops first.
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
            Statement::Loop { body, continuing, break_if } => {
                let number = added.first + spans.len() as u32;
                spans.push(span.map_or(Span::UNDEFINED, |span| *span));
                visit(body, expressions, added, spans);
                visit(continuing, expressions, added, spans);
                *break_if = Some(count(continuing, expressions, added, number + 1, *break_if));
            }
            _ => {}
        }
    }
}

/// `rounds += 1; ended = select(ended, number, rounds == most);`, and the condition `break_if || rounds >= most`.
fn count(
    continuing: &mut Block,
    expressions: &mut Arena<Expression>,
    added: &Added,
    number: u32,
    break_if: Option<Handle<Expression>>,
) -> Handle<Expression> {
    let mut add = |expression| expressions.append(expression, Span::UNDEFINED);
    let [rounds, ended] = [added.rounds, added.ended].map(|variable| add(Expression::GlobalVariable(variable)));
    let [one, most, number] = [1, added.most, number].map(|n| add(Expression::Literal(Literal::U32(n))));
    let before = add(Expression::Load { pointer: rounds });
    let now = add(Expression::Binary { op: BinaryOperator::Add, left: before, right: one });
    let last = add(Expression::Binary { op: BinaryOperator::Equal, left: now, right: most });
    let reject = add(Expression::Load { pointer: ended });
    let place = add(Expression::Select { condition: last, accept: number, reject });
    let over = add(Expression::Binary { op: BinaryOperator::GreaterEqual, left: now, right: most });
    let either = break_if.map(|left| add(Expression::Binary { op: BinaryOperator::InclusiveOr, left, right: over }));
    let leaves = either.unwrap_or(over);
    for statement in [
        Statement::Emit(Range::new_from_bounds(before, leaves)),
        Statement::Store { pointer: rounds, value: now },
        Statement::Store { pointer: ended, value: place },
    ] {
        continuing.push(statement, Span::UNDEFINED);
    }
    leaves
}

/// Puts [`tell`] before every return below a block of an entry point, but for those that no loop can come before. `ran`: whether
/// one can come before the block, and after it, before what follows.
fn tell_at_returns(block: &mut Block, expressions: &mut Arena<Expression>, added: &Added, ran: &mut bool) {
    let mut told = Block::new();
    for (mut statement, span) in std::mem::take(block).span_into_iter() {
        let mut inside = |block: &mut Block, ran: &mut bool| tell_at_returns(block, expressions, added, ran);
        match &mut statement {
            Statement::Block(inner) => inside(inner, ran),
            Statement::If { accept, reject, .. } => {
                inside(accept, ran);
                inside(reject, ran);
            }
            Statement::Switch { cases, .. } => cases.iter_mut().for_each(|case| inside(&mut case.body, ran)),
            Statement::Loop { body, .. } => {
                *ran = true;
                inside(body, ran);
            }
            Statement::Call { .. } => *ran = true,
            Statement::Return { .. } if *ran => told.extend_block(tell(expressions, added)),
            _ => {}
        }
        told.push(statement, span);
    }
    *block = told;
}

/// `if ended != 0 { faults[0] += 1; faults[1] = max(faults[1], ended); }`
fn tell(expressions: &mut Arena<Expression>, added: &Added) -> Block {
    let mut add = |expression| expressions.append(expression, Span::UNDEFINED);
    let pointer = add(Expression::GlobalVariable(added.ended));
    let faults = add(Expression::GlobalVariable(added.faults));
    let [zero, one] = [0, 1].map(|n| add(Expression::Literal(Literal::U32(n))));
    let ended = add(Expression::Load { pointer });
    let condition = add(Expression::Binary { op: BinaryOperator::NotEqual, left: ended, right: zero });
    let count = add(Expression::AccessIndex { base: faults, index: 0 });
    let place = add(Expression::AccessIndex { base: faults, index: 1 });
    let atomic = |pointer, fun, value| Statement::Atomic { pointer, fun, value, result: None };
    let accept = Block::from_vec(vec![
        Statement::Emit(Range::new_from_bounds(count, place)),
        atomic(count, AtomicFunction::Add, one),
        atomic(place, AtomicFunction::Max, ended),
    ]);
    Block::from_vec(vec![
        Statement::Emit(Range::new_from_bounds(ended, condition)),
        Statement::If { condition, accept, reject: Block::new() },
    ])
}
