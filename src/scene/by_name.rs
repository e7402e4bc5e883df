//! A document says every field by its name. Serde's derived readers also take a list for a struct, its items in the order of the
//! fields, as formats without names need it; of a document that would be misread without a word.

use std::fmt;

use serde::Deserializer;
use serde::de::{
    DeserializeOwned, DeserializeSeed, EnumAccess, Error, MapAccess, SeqAccess, Unexpected,
    VariantAccess, Visitor,
};

/// Reads JSON without a document between, whose lists stand for no struct.
pub(super) fn from_json<T: DeserializeOwned>(text: &str) -> serde_json::Result<T> {
    let mut reader = serde_json::Deserializer::from_str(text);
    let read = T::deserialize(ByName(&mut reader))?;
    reader.end()?;
    Ok(read)
}

/// A deserializer, or what one hands out, beneath which lists stand for no struct.
pub(super) struct ByName<T>(pub T);

/// A visitor beneath which lists stand for no struct.
struct Reader<V> {
    visitor: V,
    /// Whether it reads a struct itself.
    is_struct: bool,
}

impl<V> Reader<V> {
    fn any(visitor: V) -> Self {
        let is_struct = false;
        Self { visitor, is_struct }
    }

    fn of_struct(visitor: V) -> Self {
        let is_struct = true;
        Self { visitor, is_struct }
    }
}

macro_rules! deserialize {
    ($($kind:ident($($name:ident: $type:ty),*) by $reader:ident;)*) => {$(
        fn $kind<V: Visitor<'de>>(self, $($name: $type,)* visitor: V) -> Result<V::Value, D::Error> {
            self.0.$kind($($name,)* Reader::$reader(visitor))
        }
    )*};
}

impl<'de, D: Deserializer<'de>> Deserializer<'de> for ByName<D> {
    type Error = D::Error;

    deserialize! {
        deserialize_any() by any;
        deserialize_bool() by any;
        deserialize_i8() by any;
        deserialize_i16() by any;
        deserialize_i32() by any;
        deserialize_i64() by any;
        deserialize_i128() by any;
        deserialize_u8() by any;
        deserialize_u16() by any;
        deserialize_u32() by any;
        deserialize_u64() by any;
        deserialize_u128() by any;
        deserialize_f32() by any;
        deserialize_f64() by any;
        deserialize_char() by any;
        deserialize_str() by any;
        deserialize_string() by any;
        deserialize_bytes() by any;
        deserialize_byte_buf() by any;
        deserialize_option() by any;
        deserialize_unit() by any;
        deserialize_unit_struct(name: &'static str) by any;
        deserialize_newtype_struct(name: &'static str) by any;
        deserialize_seq() by any;
        deserialize_tuple(length: usize) by any;
        deserialize_tuple_struct(name: &'static str, length: usize) by any;
        deserialize_map() by any;
        deserialize_struct(name: &'static str, fields: &'static [&'static str]) by of_struct;
        deserialize_enum(name: &'static str, variants: &'static [&'static str]) by any;
        deserialize_identifier() by any;
        deserialize_ignored_any() by any;
    }

    fn is_human_readable(&self) -> bool {
        self.0.is_human_readable()
    }
}

macro_rules! visit {
    ($($kind:ident($type:ty);)*) => {$(
        fn $kind<E: Error>(self, value: $type) -> Result<V::Value, E> {
            self.visitor.$kind(value)
        }
    )*};
}

macro_rules! visit_within {
    ($($kind:ident($type:ident);)*) => {$(
        fn $kind<A: $type<'de>>(self, inner: A) -> Result<V::Value, A::Error> {
            self.visitor.$kind(ByName(inner))
        }
    )*};
}

impl<'de, V: Visitor<'de>> Visitor<'de> for Reader<V> {
    type Value = V::Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.visitor.expecting(f)
    }

    visit! {
        visit_bool(bool);
        visit_i8(i8);
        visit_i16(i16);
        visit_i32(i32);
        visit_i64(i64);
        visit_i128(i128);
        visit_u8(u8);
        visit_u16(u16);
        visit_u32(u32);
        visit_u64(u64);
        visit_u128(u128);
        visit_f32(f32);
        visit_f64(f64);
        visit_char(char);
        visit_str(&str);
        visit_borrowed_str(&'de str);
        visit_string(String);
        visit_bytes(&[u8]);
        visit_borrowed_bytes(&'de [u8]);
        visit_byte_buf(Vec<u8>);
    }

    fn visit_none<E: Error>(self) -> Result<V::Value, E> {
        self.visitor.visit_none()
    }

    fn visit_unit<E: Error>(self) -> Result<V::Value, E> {
        self.visitor.visit_unit()
    }

    fn visit_seq<A: SeqAccess<'de>>(self, items: A) -> Result<V::Value, A::Error> {
        if self.is_struct {
            return Err(A::Error::invalid_type(Unexpected::Seq, &self));
        }
        self.visitor.visit_seq(ByName(items))
    }

    visit_within! {
        visit_some(Deserializer);
        visit_newtype_struct(Deserializer);
        visit_map(MapAccess);
        visit_enum(EnumAccess);
    }
}

impl<'de, S: DeserializeSeed<'de>> DeserializeSeed<'de> for ByName<S> {
    type Value = S::Value;

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<S::Value, D::Error> {
        self.0.deserialize(ByName(from))
    }
}

impl<'de, A: SeqAccess<'de>> SeqAccess<'de> for ByName<A> {
    type Error = A::Error;

    fn next_element_seed<S: DeserializeSeed<'de>>(
        &mut self,
        seed: S,
    ) -> Result<Option<S::Value>, A::Error> {
        self.0.next_element_seed(ByName(seed))
    }

    fn size_hint(&self) -> Option<usize> {
        self.0.size_hint()
    }
}

impl<'de, A: MapAccess<'de>> MapAccess<'de> for ByName<A> {
    type Error = A::Error;

    fn next_key_seed<S: DeserializeSeed<'de>>(
        &mut self,
        seed: S,
    ) -> Result<Option<S::Value>, A::Error> {
        self.0.next_key_seed(seed)
    }

    fn next_value_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<S::Value, A::Error> {
        self.0.next_value_seed(ByName(seed))
    }

    fn size_hint(&self) -> Option<usize> {
        self.0.size_hint()
    }
}

impl<'de, A: EnumAccess<'de>> EnumAccess<'de> for ByName<A> {
    type Error = A::Error;
    type Variant = ByName<A::Variant>;

    fn variant_seed<S: DeserializeSeed<'de>>(
        self,
        seed: S,
    ) -> Result<(S::Value, Self::Variant), A::Error> {
        let (name, variant) = self.0.variant_seed(seed)?;
        Ok((name, ByName(variant)))
    }
}

impl<'de, A: VariantAccess<'de>> VariantAccess<'de> for ByName<A> {
    type Error = A::Error;

    fn unit_variant(self) -> Result<(), A::Error> {
        self.0.unit_variant()
    }

    fn newtype_variant_seed<S: DeserializeSeed<'de>>(self, seed: S) -> Result<S::Value, A::Error> {
        self.0.newtype_variant_seed(ByName(seed))
    }

    fn tuple_variant<V: Visitor<'de>>(
        self,
        length: usize,
        visitor: V,
    ) -> Result<V::Value, A::Error> {
        self.0.tuple_variant(length, Reader::any(visitor))
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, A::Error> {
        self.0.struct_variant(fields, Reader::of_struct(visitor))
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
