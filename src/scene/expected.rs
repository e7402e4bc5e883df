//! Words for what is allowed at a place of a document, in terms of the document; serde's messages name Rust types.

/// The least similarity, by Jaro and Winkler, to an unknown name at which a known one is suggested.
const LIKE: f64 = 0.8;

/// Words for what is allowed where a message of serde refuses a value; for a missing field the message itself.
pub(super) fn allowed(message: &str) -> String {
    if let Some(refused) = message.strip_prefix("unknown field ") {
        let names: Vec<&str> = refused.split('`').skip(1).step_by(2).collect();
        if let [name, known @ ..] = names.as_slice() {
            return no_such_field(name, known);
        }
    }
    match message.split_once(", expected ") {
        Some((_, expected)) => in_words(expected),
        None => message.replace('`', "\""),
    }
}

/// The known name that an unknown one is most like, where it is like any.
pub(super) fn nearest<'a>(name: &str, known: &[&'a str]) -> Option<&'a str> {
    let likeness = |other: &&str| strsim::jaro_winkler(name, other);
    let like = known.iter().copied().filter(|of| likeness(of) >= LIKE);
    like.max_by(|a, b| likeness(a).total_cmp(&likeness(b)))
}

/// Words for an unknown field: the one that may be meant, and all that exist.
pub(super) fn no_such_field(name: &str, known: &[&str]) -> String {
    let perhaps = nearest(name, known)
        .map(|nearest| format!(", perhaps {nearest}"))
        .unwrap_or_default();
    match known {
        [] => "no such field; there is none yet".to_owned(),
        known => format!("no such field{perhaps}; there are: {}", known.join(", ")),
    }
}

fn in_words(expected: &str) -> String {
    let of_length = expected.strip_prefix("an array of length ");
    match expected {
        "f64" => "a number".to_owned(),
        "u32" | "u64" | "usize" => "a whole number, 0 or more".to_owned(),
        "i8" => "a whole number".to_owned(),
        "a boolean" => "true or false".to_owned(),
        "a string" => "a text in quotes".to_owned(),
        "a sequence" => "a list".to_owned(),
        "a map" => "a table".to_owned(),
        "string or map" => "a name in quotes, or a table".to_owned(),
        "map with a single key" => "a table of one name".to_owned(),
        "unit" => "the name alone, in quotes".to_owned(),
        "newtype variant" => "a value after the name: { name = … }".to_owned(),
        _ if expected.starts_with("struct ") => "a table".to_owned(),
        _ => match of_length {
            Some(length) => format!("a list of {length} values"),
            None => expected.replace('`', "\""),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Golden: no word of Rust, and no ticks where TOML has quotes.
    #[test]
    fn messages_use_the_terms_of_documents() {
        for (message, expected) in [
            ("invalid type: string \"much\", expected f64", "a number"),
            (
                "invalid length 2, expected an array of length 3",
                "a list of 3 values",
            ),
            ("invalid type: integer `7`, expected struct Row", "a table"),
            (
                "unknown variant `x`, expected `outer` or `inner`",
                "\"outer\" or \"inner\"",
            ),
            (
                "invalid type: integer `5`, expected unit",
                "the name alone, in quotes",
            ),
            (
                "invalid value: map, expected map with a single key",
                "a table of one name",
            ),
            ("missing field `row`", "missing field \"row\""),
            (
                "unknown field `x`, expected `y` or `z`",
                "no such field; there are: y, z",
            ),
            (
                "unknown field `masss`, expected one of `matter`, `mass`, `width`",
                "no such field, perhaps mass; there are: matter, mass, width",
            ),
            (
                "unknown field `x`, there are no fields",
                "no such field; there is none yet",
            ),
        ] {
            assert_eq!(allowed(message), expected);
        }
    }
}
