//! Reads a document, and finds the path of what is wrong in it.
//!
//! A document names every field. Serde's derived readers also accept a list for a struct, its items in the order of the fields; such a
//! list could be misread unnoticed and is refused here. There is one reader for all formats: each is first parsed into a JSON
//! value, so that every type of a scene is compiled for this reader only.

use std::fmt;

use serde::Deserializer;
use serde::de::value::StrDeserializer;
use serde::de::{
    DeserializeOwned, DeserializeSeed, EnumAccess, Error as _, MapAccess, SeqAccess, Unexpected,
    VariantAccess, Visitor,
};
use serde::forward_to_deserialize_any;
use serde_json::{Map, Value, map};

use super::expected;
use super::path::{self, Segment};
use crate::base::error::{Error, Result};

/// Reads a document, or a part of one; its messages say where.
pub(crate) fn interpret<T: DeserializeOwned>(document: &Value, part: &str) -> Result<T> {
    T::deserialize(Reader(document)).map_err(|mut misread| {
        misread.enter_field();
        let segments = || misread.place.iter().rev();
        let value = path::at(document, segments()).map_or_else(|| "absent".to_owned(), path::short);
        let place = match (part, path::place(segments())) {
            (part, place) if place.is_empty() => part.to_owned(),
            ("scene" | "run", place) => place,
            (part, place) => format!("{part}.{place}"),
        };
        let allowed = expected::allowed(&misread.message);
        if part == "run" {
            Error::argument(place, value, allowed)
        } else {
            Error::scene(place, value, allowed)
        }
    })
}

/// The message of a value that does not fit what other fields of its table say: [`interpret`] reports it at its field.
pub(super) fn at_field<E: serde::de::Error>(field: &str, allowed: &str) -> E {
    E::custom(format!("{MISFIT}{field}`, expected {allowed}"))
}

/// Beginning of such a message.
const MISFIT: &str = "misfit of field `";

/// Misfit of a document, as serde words it, and its place, the innermost segment first.
#[derive(Debug)]
struct Misread {
    message: String,
    place: Vec<Segment>,
}

impl Misread {
    /// Puts a misfit at its field.
    fn enter_field(&mut self) {
        let misfit = self.message.strip_prefix(MISFIT);
        if let Some((field, _)) = misfit.and_then(|of| of.split_once('`')) {
            self.place.insert(0, Segment::Field(field.to_owned()));
        }
    }

    fn within(mut self, step: Segment) -> Self {
        self.place.push(step);
        self
    }
}

impl fmt::Display for Misread {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Misread {}

impl serde::de::Error for Misread {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self {
            message: message.to_string(),
            place: Vec::new(),
        }
    }
}

impl From<serde_json::Error> for Misread {
    fn from(error: serde_json::Error) -> Self {
        Self::custom(error)
    }
}

type Read<T> = std::result::Result<T, Misread>;

/// Reads a value of a document.
#[derive(Clone, Copy)]
struct Reader<'de>(&'de Value);

impl<'de> Reader<'de> {
    fn unexpected(self) -> Unexpected<'de> {
        match self.0 {
            Value::Null => Unexpected::Unit,
            Value::Bool(value) => Unexpected::Bool(*value),
            Value::Number(number) => match (number.as_u64(), number.as_i64(), number.as_f64()) {
                (Some(value), ..) => Unexpected::Unsigned(value),
                (_, Some(value), _) => Unexpected::Signed(value),
                (.., value) => Unexpected::Float(value.unwrap_or(f64::NAN)),
            },
            Value::String(text) => Unexpected::Str(text),
            Value::Array(_) => Unexpected::Seq,
            Value::Object(_) => Unexpected::Map,
        }
    }
}

/// Values that serde_json reads as well: nothing lies beneath them.
macro_rules! leaf {
    ($($kind:ident)*) => {$(
        fn $kind<V: Visitor<'de>>(self, visitor: V) -> Read<V::Value> {
            Ok(self.0.$kind(visitor)?)
        }
    )*};
}

impl<'de> Deserializer<'de> for Reader<'de> {
    type Error = Misread;

    leaf! {
        deserialize_bool deserialize_i8 deserialize_i16 deserialize_i32 deserialize_i64 deserialize_u8 deserialize_u16 deserialize_u32
        deserialize_u64 deserialize_f32 deserialize_f64 deserialize_str deserialize_string deserialize_unit
    }

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Read<V::Value> {
        match self.0 {
            Value::Array(items) => visitor.visit_seq(Items(items.iter().enumerate())),
            Value::Object(fields) => visitor.visit_map(Fields::of(fields)),
            leaf => Ok(leaf.deserialize_any(visitor)?),
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Read<V::Value> {
        match self.0 {
            Value::Null => visitor.visit_none(),
            _ => visitor.visit_some(self),
        }
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Read<V::Value> {
        match self.0 {
            Value::Array(_) => self.deserialize_any(visitor),
            _ => Err(Misread::invalid_type(self.unexpected(), &visitor)),
        }
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, length: usize, visitor: V) -> Read<V::Value> {
        let Value::Array(items) = self.0 else {
            return self.deserialize_seq(visitor);
        };
        let mut left = Items(items.iter().enumerate());
        let read = visitor.visit_seq(&mut left)?;
        // Too few items are reported by the visitor, after it has read them.
        if left.0.len() == 0 {
            return Ok(read);
        }
        let allowed = format!("an array of length {length}");
        Err(Misread::invalid_length(items.len(), &&*allowed))
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Read<V::Value> {
        match self.0 {
            Value::Object(_) => self.deserialize_any(visitor),
            _ => Err(Misread::invalid_type(self.unexpected(), &visitor)),
        }
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Read<V::Value> {
        self.deserialize_map(visitor)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> Read<V::Value> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Read<V::Value> {
        match self.0 {
            Value::String(name) => visitor.visit_enum(VariantReader { name, value: None }),
            Value::Object(fields) if fields.len() == 1 => {
                let (name, value) = fields.iter().next().expect("it has one");
                let value = Some(Reader(value));
                visitor.visit_enum(VariantReader { name, value })
            }
            Value::Object(_) => Err(Misread::invalid_value(
                Unexpected::Map,
                &"map with a single key",
            )),
            _ => Err(Misread::invalid_type(self.unexpected(), &"string or map")),
        }
    }

    forward_to_deserialize_any! {
        i128 u128 char bytes byte_buf unit_struct tuple_struct identifier ignored_any
    }
}

/// Items of a list.
struct Items<'de>(std::iter::Enumerate<std::slice::Iter<'de, Value>>);

impl<'de> SeqAccess<'de> for Items<'de> {
    type Error = Misread;

    fn next_element_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Read<Option<S::Value>> {
        let read = |(i, item)| {
            let read = seed.deserialize(Reader(item));
            read.map_err(|e| e.within(Segment::Item(i)))
        };
        self.0.next().map(read).transpose()
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.0.len())
    }
}

/// Fields of a table.
struct Fields<'de> {
    left: map::Iter<'de>,
    /// The one whose name has been read.
    field: Option<(&'de String, &'de Value)>,
}

impl<'de> Fields<'de> {
    fn of(fields: &'de Map<String, Value>) -> Self {
        Self {
            left: fields.iter(),
            field: None,
        }
    }
}

impl<'de> MapAccess<'de> for Fields<'de> {
    type Error = Misread;

    fn next_key_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Read<Option<S::Value>> {
        self.field = self.left.next();
        let read = |(name, _): (&'de String, _)| {
            let read = seed.deserialize(StrDeserializer::<Misread>::new(name));
            read.map_err(|e| e.within(Segment::Field(name.clone())))
        };
        self.field.map(read).transpose()
    }

    fn next_value_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Read<S::Value> {
        let (name, value) = self.field.expect("a name is read before its value");
        let read = seed.deserialize(Reader(value));
        read.map_err(|e| e.within(Segment::Field(name.clone())))
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.left.len())
    }
}

/// The name of a variant, alone or with its value.
struct VariantReader<'de> {
    name: &'de str,
    value: Option<Reader<'de>>,
}

impl<'de> VariantReader<'de> {
    fn within(&self, misread: Misread) -> Misread {
        match self.value {
            Some(_) => misread.within(Segment::Field(self.name.to_owned())),
            None => misread,
        }
    }

    fn value(&self, expected: &'static str) -> Read<Reader<'de>> {
        self.value
            .ok_or_else(|| Misread::invalid_type(Unexpected::UnitVariant, &expected))
    }
}

impl<'de> EnumAccess<'de> for VariantReader<'de> {
    type Error = Misread;
    type Variant = Self;

    fn variant_seed<S: DeserializeSeed<'de>>(self, seed: S) -> Read<(S::Value, Self)> {
        let name = seed.deserialize(StrDeserializer::<Misread>::new(self.name))?;
        Ok((name, self))
    }
}

impl<'de> VariantAccess<'de> for VariantReader<'de> {
    type Error = Misread;

    fn unit_variant(self) -> Read<()> {
        match self.value {
            None => Ok(()),
            Some(value) => {
                let nothing = value.0.deserialize_unit(serde::de::IgnoredAny);
                nothing.map(|_| ()).map_err(|e| self.within(e.into()))
            }
        }
    }

    fn newtype_variant_seed<S: DeserializeSeed<'de>>(self, seed: S) -> Read<S::Value> {
        let value = self.value("newtype variant")?;
        seed.deserialize(value).map_err(|e| self.within(e))
    }

    fn tuple_variant<V: Visitor<'de>>(self, length: usize, visitor: V) -> Read<V::Value> {
        let value = self.value("tuple variant")?;
        value
            .deserialize_tuple(length, visitor)
            .map_err(|e| self.within(e))
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        _: &'static [&'static str],
        visitor: V,
    ) -> Read<V::Value> {
        let value = self.value("struct variant")?;
        value.deserialize_map(visitor).map_err(|e| self.within(e))
    }
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use crate::scene::{Lubricant, Scene, presets};
    use crate::{Error, Run};

    fn scene() -> Scene {
        let mut scene = presets::wheel_bearing(100.0);
        scene.lubricant = Some(Lubricant::named("vg68", 330.0));
        scene
    }

    /// The place that a scene with a list in a place of a document is refused by: read straight, and put there by its path.
    fn refused(pointer: &str, list: Value) -> [String; 2] {
        let of = |scene: crate::Result<Scene>| match scene {
            Err(Error::Scene { path, allowed, .. }) if allowed == "a table" => path,
            other => panic!("{pointer}: {other:?}"),
        };
        let path = pointer[1..].replace("/1", "[1]").replace('/', ".");
        let mut document = serde_json::to_value(scene()).unwrap();
        *document.pointer_mut(pointer).expect(pointer) = list.clone();
        let straight = Scene::from_json(&document.to_string());
        [straight, scene().with(&[(&path, list)])].map(of)
    }

    #[test]
    fn a_list_stands_for_no_struct() {
        for (pointer, list, place) in [
            ("/cage", json!([1e6, 20.0, 1e-4]), "cage"),
            ("/rows/1", json!([9, 8e-3, 4e-2, 0.52, 0.52]), "rows[1]"),
            ("/lubricant", json!(["vg68"]), "lubricant"),
            ("/friction/coulomb", json!([0.05, 0.1]), "friction.coulomb"),
            (
                "/loads/radial",
                json!(["inner", [0, -1, 0], 1]),
                "loads.radial",
            ),
            (
                "/probes/outer/motion",
                json!(["outer", null]),
                "probes.outer.motion",
            ),
            (
                "/inner_ring/support/x/spring",
                json!([0, 1]),
                "inner_ring.support.x.spring",
            ),
        ] {
            assert_eq!(refused(pointer, list), [place; 2]);
        }
        assert!(Scene::from_json(r#"[1, "name", []]"#).is_err());
        assert!(Run::from_json("[0.5]").is_err());
    }

    #[test]
    fn what_is_written_is_read() {
        let text = scene().to_json();
        assert_eq!(Scene::from_json(&text), Ok(scene()));
        assert!(Scene::from_json(&format!("{text} x")).is_err());
    }
}
