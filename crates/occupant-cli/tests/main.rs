//! The command as a user meets it, a module each subject, in one binary: linking each of them alone would cost more than
//! running it.

mod command_line;
mod common;
mod convert;
mod drive;
mod ensembles;
mod everyday;
mod examined;
mod fit;
mod ghosts;
mod histories;
mod laboratory;
mod optimise;
mod pages;
mod pictures;
mod print;
mod recorders;
mod recording;
mod records;
mod risk;
mod seal;
mod sensitivity;
mod study;
mod surfaces;
mod sweep;
mod trust;
