//! Words of recorders' reports, for everything that is no heading of motion: English, German, French, Spanish and romanised
//! Japanese, in small letters without accents ([`folded`]). Words of motion are those of headings (`column_named`).

use occupant_scenario::folded;

/// Beginnings of words.
pub(super) type Stems = &'static [&'static str];

pub(super) const BELT: Stems = &[
    "belt",
    "seatbelt",
    "buckle s",
    "gurt",
    "sicherheitsgurt",
    "ceinture",
    "cinturon",
    "shitoberuto",
    "siitoberuto",
    "beruto",
];
pub(super) const PRETENSIONER: Stems = &[
    "pretension",
    "pre-tension",
    "pre tension",
    "straffer",
    "gurtstraffer",
    "pretendeur",
    "pre-tendeur",
    "pretensor",
    "puritenshona",
];
pub(super) const BAG: Stems = &[
    "air bag",
    "deployment command",
    "airbag",
    "air-bag",
    "frontairbag",
    "fahrerairbag",
    "sac gonflable",
    "coussin gonflable",
    "bolsa de aire",
    "eabaggu",
    "ea baggu",
    "eabagu",
];
/// Values that tell of a belt by themselves.
pub(super) const BELTED: Stems = &[
    "belted",
    "unbelted",
    "buckled",
    "unbuckled",
    "fastened",
    "unfastened",
    "angeschnallt",
    "gegurtet",
    "ungegurtet",
    "abrochad",
    "desabrochad",
    "bouclee",
    "debouclee",
    "attachee",
    "detachee",
    "chakuyo",
    "michakuyo",
];
/// What tells that something fired.
pub(super) const FIRING: Stems =
    &["deploy", "time to", "firing", "fired", "fire", "zund", "auslos", "declench", "despliegue", "tenkai", "activat"];
/// Bags and straps that are not the driver's front bag.
pub(super) const OTHER_BAG: Stems = &[
    "side", "curtain", "knee", "seiten", "kopf", "vorhang", "knie", "lateral", "rideau", "genou", "cortina", "rodilla",
    "saido", "katen", "hiza", "lamp", "warning", "warnl", "kontroll", "temoin", "testigo", "keikoku", "suppress",
    "cutoff", "disposal",
];
pub(super) const LATER_STAGE: Stems = &[
    "2nd", "second", "stage 2", "stufe 2", "2. stufe", "zweite", "deuxieme", "2e etage", "segunda", "2a etapa",
    "etapa 2", "dai2", "dai 2",
];
pub(super) const DRIVER: Stems =
    &["driver", "fahrer", "conducteur", "conductor", "untensha", "untenshu", "untenseki", "left front", "front left"];
pub(super) const PASSENGER: Stems = &[
    "passenger",
    "beifahrer",
    "passager",
    "pasajero",
    "acompanante",
    "copiloto",
    "joshuseki",
    "right front",
    "front right",
    "rear seat",
];
/// The first heading of a table of seats or devices.
pub(super) const SEAT: Stems = &[
    "seat", "occupant", "item", "element", "sitz", "insasse", "siege", "asiento", "ocupante", "zaseki", "position",
    "platz",
];
pub(super) const MAXIMUM: Stems = &["max", "peak", "hochst", "gross", "saidai"];
pub(super) const BRAKE: Stems =
    &["brake", "bremse", "betriebsbremse", "bremspedal", "frein", "freno", "bureki", "bureeki"];
pub(super) const BEFORE: Stems = &["before", "prior to", "vor", "avant", "antes", "mae"];
pub(super) const PRE_CRASH: Stems = &[
    "pre-crash",
    "precrash",
    "pre crash",
    "pre_crash",
    "vor dem",
    "vor der",
    "avant",
    "previo",
    "previos",
    "antes",
    "shototsu mae",
    "pre-choc",
    "pre-collision",
    "vorlauf",
    "pre-impact",
];
/// What tells the kind or the direction of the impact.
pub(super) const IMPACT: Stems = &[
    "impact",
    "tsuitotsu",
    "rear-end",
    "head-on",
    "frontal crash",
    "rear crash",
    "side crash",
    "heckaufprall",
    "frontalaufprall",
    "seitenaufprall",
    "auffahrunfall",
    "alcance",
    "collision",
    "crash type",
    "crash direction",
    "event type",
    "type of event",
    "type of crash",
    "area of damage",
    "damage area",
    "direction",
    "aufprall",
    "anstoss",
    "kollision",
    "unfallart",
    "ereignisart",
    "richtung",
    "choc",
    "type d'evenement",
    "impacto",
    "colision",
    "tipo de evento",
    "shototsu",
    "principal",
    "pdof",
    "damage",
];
pub(super) const SPEED_AT_IMPACT: Stems = &[
    "speed at impact",
    "vehicle speed",
    "pre-crash speed",
    "initial speed",
    "speed at t",
    "speed at event",
    "speed at trigger",
    "anfangsgeschwindigkeit",
    "fahrzeuggeschwindigkeit",
    "velocidad inicial",
    "vitesse initiale",
    "vitesse avant",
    "impact speed",
    "speed at collision",
    "collision speed",
    "vehicle speed at impact",
    "velocity at impact",
    "kollisionsgeschwindigkeit",
    "aufprallgeschwindigkeit",
    "geschwindigkeit bei kollision",
    "geschwindigkeit beim aufprall",
    "geschwindigkeit bei aufprall",
    "vitesse d'impact",
    "vitesse au choc",
    "vitesse a l'impact",
    "vitesse au moment de l'impact",
    "velocidad de impacto",
    "velocidad al impacto",
    "velocidad en el impacto",
    "shototsu sokudo",
    "shototsuji sokudo",
    "shototsu-ji sokudo",
];
pub(super) const FRONT: Stems = &[
    "front",
    "head-on",
    "head on",
    "vorn",
    "choc avant",
    "impact avant",
    "face avant",
    "partie avant",
    "delanter",
    "zenmen",
    "shomen",
    "zenpo",
    "12 o'clock",
    "12 uhr",
];
pub(super) const REAR: Stems = &[
    "rear",
    "alcance",
    "heck",
    "hinten",
    "arriere",
    "traser",
    "posterior",
    "koho",
    "kouho",
    "tsuitotsu",
    "6 o'clock",
    "6 uhr",
    "auffahr",
];
pub(super) const LEFT: Stems =
    &["left", "link", "gauche", "izquierd", "hidari", "9 o'clock", "9 uhr", "driver side", "driver's side"];
pub(super) const RIGHT: Stems =
    &["right", "recht", "droit", "derech", "migi", "3 o'clock", "3 uhr", "passenger side", "passenger's side"];
/// A loss of speed as a positive number.
pub(super) const LOSS: Stems = &[
    "decel",
    "loss",
    "reduction",
    "decrease",
    "slowing",
    "verzogerung",
    "verzoegerung",
    "langsverzogerung",
    "querverzogerung",
    "abnahme",
    "verlust",
    "geschwindigkeitsabnahme",
    "geschwindigkeitsverlust",
    "reduktion",
    "perte",
    "diminution",
    "perdida",
    "reduccion",
    "desaceleracion",
    "gensoku",
    "gensokudo",
    "gensho",
];
pub(super) const UNSIGNED: Stems = &[
    "magnitude",
    "absolute value",
    "unsigned",
    "without sign",
    "betrag",
    "ohne vorzeichen",
    "absolutwert",
    "valeur absolue",
    "sans signe",
    "valor absoluto",
    "sin signo",
    "zettaichi",
];
pub(super) const POSITIVE: Stems = &["positive", "positiv", "positif", "positivo", "positiva", "plus", "sei no", "(+)"];
pub(super) const FORWARD: Stems = &[
    "forward",
    "vorwarts",
    "nach vorn",
    "fahrtrichtung",
    "vers l'avant",
    "hacia adelante",
    "hacia delante",
    "zenpo",
    "rear impact",
    "gain",
    "increase",
];
pub(super) const INTERVAL: Stems = &[
    "interval",
    "intervall",
    "intervalle",
    "intervalo",
    "per 10",
    "per ms",
    "each 10",
    "per sample",
    "incremental",
    "increment",
    "per step",
    "je 10",
    "pro 10",
    "pro schritt",
    "par 10",
    "par pas",
    "cada 10",
    "por paso",
    "kankaku",
    "goto",
];
pub(super) const CUMULATIVE: Stems = &["cumulat", "cum", "kumul", "acumul", "ruiseki"];
pub(super) const COMPLETE: Stems = &["complete", "vollstandig", "complet", "completo", "kanzen"];
pub(super) const SEAT_TRACK: Stems = &[
    "seat track",
    "seat position",
    "sitzposition",
    "sitzstellung",
    "position du siege",
    "posicion del asiento",
    "shito ichi",
    "occupant size",
];

const UNKNOWN: Stems = &[
    "unknown",
    "not available",
    "not recorded",
    "data not",
    "invalid",
    "unbekannt",
    "keine angabe",
    "nicht verfugbar",
    "nicht aufgezeichnet",
    "inconnu",
    "non disponible",
    "non enregistre",
    "indisponible",
    "desconocid",
    "no disponible",
    "no registrad",
    "fumei",
    "fault",
    "error",
    "sna",
];
/// Whole words that deny.
const NO: &[&str] = &[
    "no",
    "off",
    "not",
    "none",
    "false",
    "un",
    "unbuckled",
    "unfastened",
    "unbelted",
    "unlatched",
    "unused",
    "released",
    "inactive",
    "nicht",
    "aus",
    "nein",
    "offen",
    "kein",
    "ungegurtet",
    "non",
    "pas",
    "debouclee",
    "detachee",
    "inactif",
    "inactive",
    "desabrochado",
    "desactivado",
    "desabrochada",
    "sin",
    "inactivo",
    "michakuyo",
    "michakuyou",
    "mi",
    "nashi",
    "hi",
    "suelto",
    "non-deployment",
    "nondeployment",
    "relachee",
    "relache",
];
/// Whole words that affirm.
const YES: &[&str] = &[
    "on",
    "yes",
    "true",
    "buckled",
    "angeschnallt",
    "gegurtet",
    "fastened",
    "angeschnallt",
    "gegurtet",
    "belted",
    "latched",
    "applied",
    "deployed",
    "fired",
    "activated",
    "engaged",
    "worn",
    "used",
    "pressed",
    "angelegt",
    "ein",
    "ja",
    "betatigt",
    "ausgelost",
    "gezundet",
    "aktiv",
    "geschlossen",
    "gesteckt",
    "bouclee",
    "attachee",
    "oui",
    "actif",
    "active",
    "activee",
    "declenche",
    "declenchee",
    "enclenchee",
    "serre",
    "abrochado",
    "abrochada",
    "si",
    "activado",
    "desplegado",
    "puesto",
    "chakuyo",
    "chakuyou",
    "ari",
    "sado",
    "sadou",
    "tenkai",
    "ari",
    "pressee",
    "enfonce",
    "pisado",
    "appuye",
];

/// Whether a text in [`folded`] letters has a word that begins so.
pub(super) fn has(text: &str, stems: Stems) -> bool {
    stems
        .iter()
        .any(|stem| text.match_indices(stem).any(|(at, _)| !text[..at].ends_with(|c: char| c.is_alphanumeric())))
}

/// Whether a text means that something was on, worn or fired, or was not; none if it says neither.
pub(super) fn state(text: &str) -> Option<bool> {
    let text = folded(text);
    if has(&text, UNKNOWN) || placed_text::is_missing(&text) {
        return None;
    }
    let words: Vec<&str> = text.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty()).collect();
    let any = |of: &[&str]| words.iter().any(|word| of.contains(word));
    if any(NO) {
        return Some(false);
    }
    any(YES).then_some(true)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn states_are_read_in_five_languages() {
        for yes in
            ["On", "Buckled", "angelegt", "Bouclée", "Abrochado", "Sí", "chakuyō", "betätigt", "Yes", "ausgelöst"]
        {
            assert_eq!(state(yes), Some(true), "{yes}");
        }
        for no in
            ["Off", "Not Buckled", "nicht angelegt", "non bouclée", "No abrochado", "michakuyō", "Un-buckled", "aus"]
        {
            assert_eq!(state(no), Some(false), "{no}");
        }
        for none in ["", "N/A", "Not Available", "unbekannt", "maybe", "1", "Invalid"] {
            assert_eq!(state(none), None, "{none}");
        }
    }

    #[test]
    fn stems_begin_words() {
        assert!(has("driver airbag", BAG) && has("vordere kollision", IMPACT) && !has("unbelted", BELT));
        assert!(!has("afront", FRONT) && has("frontal impact", FRONT));
    }
}
