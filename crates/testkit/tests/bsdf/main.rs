//! Every surface, one file for each kind of check.

mod chi_square;
mod consistency;
mod energy;
mod films;
mod layers;
