//! A bearing as a functional mock-up unit (FMU): FMI 3.0, co-simulation.
//!
//! `ballrace fmu scene.toml -o bearing.fmu` packs this library with a scene and the description that the library writes of it; the
//! guide's page `docs/fmu.md` is for users. Source of the interface: Modelica Association, *Functional Mock-up Interface
//! Specification* 3.0 (<https://fmi-standard.org>); sections in brackets are its.
//!
//! | module | what it holds |
//! |---|---|
//! | `variables` | which inputs, parameters and outputs a scene has: the one table for description and interface |
//! | `description` | `modelDescription.xml` of such a table |
//! | `instance` | a simulation between communication steps, its values and states |
//! | `abi` | the functions in C, with the only `unsafe` code: pointers, texts, panics that may not cross |
//! | `checksum` | by which changed bytes of a state are noticed |
//! | `absent` | the functions of what an FMU need not have |

mod abi;
mod absent;
mod checksum;
mod description;
mod instance;
mod variables;
