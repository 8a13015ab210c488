//! Parity of the two descriptions: every operation, every field of every request and answer, by name and type.

use super::messages::{PACKAGE, message, pool, rpcs, shape};
use super::rest::Rest;
use super::rules::{FIELDS_APART, FIRST_MESSAGES, GRPC_ONLY_OPERATIONS, RENAMED_OPERATIONS, REST_ONLY_OPERATIONS};
use super::shape::{Object, Shape, compare};
use std::collections::BTreeSet;

/// The rpc of a REST operation.
pub fn rpc_name(operation: &str) -> String {
    if let Some((_, rpc)) = RENAMED_OPERATIONS.iter().find(|(rest, _)| *rest == operation) {
        return (*rpc).to_owned();
    }
    let mut letters = operation.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

fn names(table: &[(&str, &str)]) -> BTreeSet<String> {
    table.iter().map(|(name, _)| (*name).to_owned()).collect()
}

#[test]
fn every_operation_has_its_rpc_or_a_reason() {
    let operations: Vec<String> = Rest::read().operations().into_iter().map(|operation| operation.id).collect();
    assert!(operations.len() > 40, "{operations:?}");
    let rpcs: BTreeSet<String> = rpcs(&pool()).iter().map(|rpc| rpc.name().to_owned()).collect();
    let twins: BTreeSet<String> = operations.iter().map(|operation| rpc_name(operation)).collect();
    let without: BTreeSet<String> =
        operations.into_iter().filter(|operation| !rpcs.contains(&rpc_name(operation))).collect();
    assert_eq!(without, names(REST_ONLY_OPERATIONS), "operations of REST without an rpc");
    let alone: BTreeSet<String> = rpcs.into_iter().filter(|rpc| !twins.contains(rpc)).collect();
    assert_eq!(alone, names(GRPC_ONLY_OPERATIONS), "rpcs without an operation of REST");
}

#[test]
fn every_field_has_the_same_name_and_type_or_a_reason() {
    let (pool, rest) = (pool(), Rest::read());
    let rpcs = rpcs(&pool);
    let mut differences = BTreeSet::new();
    for operation in rest.operations() {
        let Some(rpc) = rpcs.iter().find(|rpc| rpc.name() == rpc_name(&operation.id)) else { continue };
        let request = match FIRST_MESSAGES.iter().find(|(rest, _)| *rest == operation.id) {
            Some((_, name)) => message(&pool, name),
            None => rpc.input(),
        };
        compare(&operation.id, &operation.request, &shape(&request), &mut differences);
        let answer = operation.response.unwrap_or_else(|| Shape::Object(Object::named(&operation.id)));
        compare(&operation.id, &answer, &shape(&rpc.output()), &mut differences);
    }
    let expected: BTreeSet<String> = names(FIELDS_APART);
    let unexpected: Vec<_> = differences.difference(&expected).collect();
    assert!(unexpected.is_empty(), "REST and gRPC differ without a reason: {unexpected:#?}");
    let stale: Vec<_> = expected.difference(&differences).collect();
    assert!(stale.is_empty(), "reasons without a difference: {stale:#?}");
}

#[test]
fn the_documentation_names_what_one_protocol_has_alone() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/api.md");
    let text = std::fs::read_to_string(path).unwrap();
    let fields = FIELDS_APART.iter().map(|(place, _)| place.rsplit([' ', '.']).next().unwrap());
    let operations = REST_ONLY_OPERATIONS.iter().chain(GRPC_ONLY_OPERATIONS).map(|(name, _)| *name);
    let missing: Vec<&str> = fields.chain(operations).filter(|name| !text.contains(&format!("`{name}`"))).collect();
    assert!(missing.is_empty(), "docs/api.md does not name {missing:?}");
}

#[test]
fn every_message_is_used() {
    let pool = pool();
    let mut used: BTreeSet<String> = BTreeSet::new();
    let mut open: Vec<_> = rpcs(&pool).iter().flat_map(|rpc| [rpc.input(), rpc.output()]).collect();
    while let Some(message) = open.pop() {
        if used.insert(message.full_name().to_owned()) {
            open.extend(message.fields().filter_map(|field| field.kind().as_message().cloned()));
        }
    }
    let ours = pool.all_messages().filter(|message| message.package_name() == PACKAGE);
    let unused: Vec<_> =
        ours.map(|message| message.full_name().to_owned()).filter(|name| !used.contains(name)).collect();
    assert!(unused.is_empty(), "messages that no rpc takes or gives: {unused:?}");
}
