//! Position constraints, mathematics (34) and (35): the equations against minimal coordinates, and runs that stay
//! where the constraints hold.

mod holonomic {
    mod assembly;
    mod car_axis;
    mod collinear_cell;
    mod coming_to_rest;
    mod delta;
    mod equal_parts;
    mod five_bar;
    mod folded_links;
    mod four_bar;
    mod hoop;
    mod kept_by_steps;
    mod kept_levels;
    mod level_table;
    mod long_runs;
    mod long_swing;
    mod loose_tolerances;
    mod maps;
    mod out_of_reach;
    mod pendulum;
    mod pins_in_line;
    mod plate;
    mod rattle;
    mod redundant;
    mod slider_crank;
    mod spatial_slider_crank;
    mod squeezer;
    mod steered_bicycle;
    mod steps_of_any_length;
    mod stewart;
    mod upright_coin;
    mod volumes;
    mod windows;
}
