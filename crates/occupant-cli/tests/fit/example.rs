//! The worked example of `scenarios/studies/fit-cart/`, with a smaller budget.

use super::*;

/// The example in a folder of its own, which stands to its scenario as in the repository.
fn example() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let scenarios = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let place = folder.path().join("studies/fit-cart");
    fs::create_dir_all(&place).unwrap();
    let copy = |from: &str, to: &str| {
        fs::copy(scenarios.join(from), folder.path().join(to)).unwrap();
    };
    copy("studies/fit-cart/cart.toml", "studies/fit-cart/cart.toml");
    for name in ["test-20mph.csv", "test-15mph.csv"] {
        let name = format!("studies/fit-cart/{name}");
        copy(&name, &name);
    }
    for name in ["fit.toml", "anchorage.toml"] {
        let text = fs::read_to_string(scenarios.join("studies/fit-cart").join(name)).unwrap();
        let text = text.replace("[fit]\n", "[fit]\nbudget = 128\n");
        fs::write(place.join(name), text).unwrap();
    }
    folder
}

#[test]
fn the_example_finds_what_was_hidden_in_its_tests() {
    let folder = example();
    let at = folder.path().join("studies/fit-cart");
    let said = done(&at, &["fit", "fit.toml", "-o", "out"]);
    let found = found(&at, "out");
    // what make_test.py hides
    let hidden = [("lap belt stiffness", 1.3), ("torso belt slack", 0.8 * 0.0254), ("seat friction", 0.45)];
    for (name, planted) in hidden {
        let p = parameter(&found, name);
        assert_eq!(p["verdict"], "identified", "{said}");
        let error = (number(&p["value"]) / planted - 1.0).abs();
        // measured with the whole budget: 0.1, 0.6 and 1.3 %, the sensors' gains being 1 % off
        assert!(error < 0.025, "{name}: {error}\n{said}");
    }
}

#[test]
fn the_example_of_webbing_and_anchorage_says_that_they_are_not_identified() {
    let folder = example();
    let at = folder.path().join("studies/fit-cart");
    let words = ["fit", "anchorage.toml", "--test", "test-20mph.csv", "-o", "out"];
    let said = done(&at, &words);
    let found = found(&at, "out");
    let value = |name| number(&parameter(&found, name)["value"]);
    let product = value("webbing") * value("anchorage");
    assert!((product / 1.3 - 1.0).abs() < 0.02, "{product}\n{said}");
    for name in ["webbing", "anchorage"] {
        assert_eq!(parameter(&found, name)["verdict"], "not_identified", "{said}");
    }
}
