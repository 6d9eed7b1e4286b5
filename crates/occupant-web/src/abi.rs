//! The functions of the module for wasm32: a page writes a request into memory and reads the answer there.
//!
//! ```text
//! reserve(length) -> address          of a place for the request, which is UTF-8
//! reserve_file(length) -> address     of a place for a file that it is about
//! answer()                       meets it
//! json(), json_length(), bytes(), bytes_length()      where the answer is
//! ```
//!
//! The page gives one function, `page.progress(share)`. After a trap, `json` has the words of the panic.
#![allow(unsafe_code)]

use std::cell::RefCell;

use crate::{Answer, call};

#[link(wasm_import_module = "page")]
unsafe extern "C" {
    /// Hears how much of a run is done, from 0 to 1.
    safe fn progress(share: f64);
}

thread_local! {
    static REQUEST: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static FILE: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static ANSWER: RefCell<Answer> = RefCell::new(Answer::default());
}

/// A place for a request of so many bytes.
// SAFETY: no other function of the module has this name
#[unsafe(no_mangle)]
pub extern "C" fn reserve(length: usize) -> *mut u8 {
    std::panic::set_hook(Box::new(|panic| put(Answer { json: panic.to_string(), bytes: Vec::new() })));
    REQUEST.with_borrow_mut(|request| {
        *request = vec![0; length];
        request.as_mut_ptr()
    })
}

/// A place for a file of so many bytes.
// SAFETY: no other function of the module has this name
#[unsafe(no_mangle)]
pub extern "C" fn reserve_file(length: usize) -> *mut u8 {
    FILE.with_borrow_mut(|file| {
        *file = vec![0; length];
        file.as_mut_ptr()
    })
}

/// Meets the request.
// SAFETY: no other function of the module has this name
#[unsafe(no_mangle)]
pub extern "C" fn answer() {
    let request = REQUEST.take();
    put(call(&String::from_utf8_lossy(&request), &FILE.take(), &mut |share| progress(share)));
}

fn put(answer: Answer) {
    ANSWER.set(answer);
}

/// Where the JSON of the answer is.
// SAFETY: no other function of the module has this name
#[unsafe(no_mangle)]
pub extern "C" fn json() -> *const u8 {
    ANSWER.with_borrow(|answer| answer.json.as_ptr())
}

/// Bytes of the JSON.
// SAFETY: no other function of the module has this name
#[unsafe(no_mangle)]
pub extern "C" fn json_length() -> usize {
    ANSWER.with_borrow(|answer| answer.json.len())
}

/// Where the file of the answer is.
// SAFETY: no other function of the module has this name
#[unsafe(no_mangle)]
pub extern "C" fn bytes() -> *const u8 {
    ANSWER.with_borrow(|answer| answer.bytes.as_ptr())
}

/// Bytes of the file.
// SAFETY: no other function of the module has this name
#[unsafe(no_mangle)]
pub extern "C" fn bytes_length() -> usize {
    ANSWER.with_borrow(|answer| answer.bytes.len())
}
