//! The tables of numbers that shaders look up, those of `lumbre-core`, in one buffer. Twin: `glsl/tables.glsl`.

use bytemuck::{Pod, Zeroable};
use lumbre_core::bsdf::{albedo, aniso_albedo, sheen};
use lumbre_core::color::srgb_decode_table;
use lumbre_core::filter::{self, Filter, FilterKind};
use lumbre_core::rgb::Rgb;
use lumbre_core::wavelength;

/// All tables.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub struct Tables {
    /// [`albedo::DEFICIT`].
    pub albedo_deficit: [[f32; albedo::N_MU]; albedo::N_ALPHA],
    /// [`albedo::SCHLICK_EXCESS`].
    pub albedo_schlick_excess: [[f32; albedo::N_MU]; albedo::N_ALPHA],
    /// [`albedo::DEFICIT_AVERAGE`].
    pub albedo_deficit_average: [f32; albedo::N_AVERAGE],
    /// [`albedo::SCHLICK_AVERAGE`].
    pub albedo_schlick_average: [f32; albedo::N_AVERAGE],
    /// [`sheen::DIRECTIONAL`].
    pub sheen_directional: [[f32; sheen::N_MU]; sheen::N_ROUGHNESS],
    /// [`sheen::AVERAGE`].
    pub sheen_average: [f32; sheen::N_ROUGHNESS],
    /// [`aniso_albedo::DEFICIT`].
    pub aniso_deficit: [i16; aniso_albedo::NODES],
    /// [`aniso_albedo::SCHLICK_RESIDUAL`].
    pub aniso_schlick_residual: [i16; aniso_albedo::NODES],
    /// [`aniso_albedo::DEFICIT_AVERAGE`].
    pub aniso_deficit_average: [[f32; aniso_albedo::AVERAGES[1]]; aniso_albedo::AVERAGES[0]],
    /// [`aniso_albedo::SCHLICK_AVERAGE`].
    pub aniso_schlick_average: [[f32; aniso_albedo::AVERAGES[1]]; aniso_albedo::AVERAGES[0]],
    /// [`wavelength::Table::response`].
    pub wavelength_response: [Rgb; wavelength::NODES],
    /// [`wavelength::Table::cdf`].
    pub wavelength_cdf: [f32; wavelength::NODES],
    /// [`Filter::distances`] of the Gaussian and the Blackman-Harris filter.
    pub filter_distance: [[f32; filter::TABLE + 1]; TABULATED_FILTERS.len()],
    /// [`srgb_decode_table`].
    pub srgb_decode: [f32; 256],
}

/// Filters that are sampled by a table: the last ones of their kind, so that shaders find a table by its number.
const TABULATED_FILTERS: [FilterKind; 2] = [FilterKind::Gaussian, FilterKind::BlackmanHarris];

/// What goes into the buffer.
pub fn tables() -> Vec<u8> {
    let tables = Tables {
        albedo_deficit: albedo::DEFICIT,
        albedo_schlick_excess: albedo::SCHLICK_EXCESS,
        albedo_deficit_average: albedo::DEFICIT_AVERAGE,
        albedo_schlick_average: albedo::SCHLICK_AVERAGE,
        sheen_directional: sheen::DIRECTIONAL,
        sheen_average: sheen::AVERAGE,
        aniso_deficit: aniso_albedo::DEFICIT,
        aniso_schlick_residual: aniso_albedo::SCHLICK_RESIDUAL,
        aniso_deficit_average: aniso_albedo::DEFICIT_AVERAGE,
        aniso_schlick_average: aniso_albedo::SCHLICK_AVERAGE,
        wavelength_response: wavelength::Table::get().response,
        wavelength_cdf: wavelength::Table::get().cdf,
        filter_distance: TABULATED_FILTERS.map(|kind| *Filter::new(kind).distances()),
        srgb_decode: *srgb_decode_table(),
    };
    bytemuck::bytes_of(&tables).to_vec()
}
