//! The rules, with the documents that set their limits.

use crate::measure::Blow;

/// A rule or test procedure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Rule {
    /// FMVSS 208.
    Fmvss208,
    /// UN Regulation 94.
    UnR94,
    /// UN Regulation 137.
    UnR137,
    /// UN Regulation 95, side.
    UnR95,
    /// UN Regulation 135, side, pole.
    UnR135,
    /// FMVSS 214, side.
    Fmvss214,
    /// UN Regulation 127, pedestrians, headforms.
    UnR127,
    /// Euro NCAP, full width frontal impact.
    EuroNcapFullWidth,
    /// Euro NCAP, frontal impact with a mobile progressive deformable barrier.
    EuroNcapMpdb,
    /// Euro NCAP, side, barrier.
    EuroNcapSideBarrier,
    /// Euro NCAP, side, pole.
    EuroNcapSidePole,
    /// Euro NCAP, whiplash, pulse of low severity (16 km/h).
    EuroNcapWhiplashLow,
    /// Euro NCAP, whiplash, pulse of medium severity (16 km/h).
    EuroNcapWhiplashMedium,
    /// Euro NCAP, whiplash, pulse of high severity (24 km/h).
    EuroNcapWhiplashHigh,
    /// IIHS, frontal impact.
    IihsFrontal,
    /// MASH 2016.
    Mash2016,
    /// MASH 2016, breakaway supports.
    Mash2016Supports,
    /// NCHRP Report 350.
    Nchrp350,
    /// NCHRP Report 350, breakaway supports and work-zone devices.
    Nchrp350Supports,
    /// EN 1317-1:1998.
    En1317Edition1998,
    /// EN 1317-1:2010, which has no PHD.
    En1317Edition2010,
    /// EN 1317-3:2010, crash cushions hit head on (TC 1 to TC 3).
    En1317CushionHeadOn,
    /// EN 1317-3:2010, crash cushions hit on the side (TC 4, TC 5).
    En1317CushionSide,
    /// EN 12767:2007 at 50, 70 or 100 km/h.
    En12767,
    /// EN 12767:2007 at 35 km/h.
    En12767Slow,
    /// Historical 1000 of the severity indices.
    SeverityIndex,
}

impl Rule {
    /// Its name as tables print it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Fmvss208 => "FMVSS 208",
            Self::UnR94 => "UN R94",
            Self::UnR137 => "UN R137",
            Self::UnR95 => "UN R95",
            Self::UnR135 => "UN R135",
            Self::Fmvss214 => "FMVSS 214",
            Self::UnR127 => "UN R127 (headform)",
            Self::EuroNcapFullWidth => "Euro NCAP full width",
            Self::EuroNcapMpdb => "Euro NCAP MPDB",
            Self::EuroNcapSideBarrier => "Euro NCAP side barrier",
            Self::EuroNcapSidePole => "Euro NCAP side pole",
            Self::EuroNcapWhiplashLow => "Euro NCAP whiplash low",
            Self::EuroNcapWhiplashMedium => "Euro NCAP whiplash medium",
            Self::EuroNcapWhiplashHigh => "Euro NCAP whiplash high",
            Self::IihsFrontal => "IIHS frontal",
            Self::Mash2016 => "MASH 2016",
            Self::Mash2016Supports => "MASH 2016 (breakaway supports)",
            Self::Nchrp350 => "NCHRP 350",
            Self::Nchrp350Supports => "NCHRP 350 (breakaway supports)",
            Self::En1317Edition1998 => "EN 1317-1:1998",
            Self::En1317Edition2010 => "EN 1317-1:2010",
            Self::En1317CushionHeadOn => "EN 1317-3 (cushion, head on)",
            Self::En1317CushionSide => "EN 1317-3 (cushion, side)",
            Self::En12767 => "EN 12767 (50 to 100 km/h)",
            Self::En12767Slow => "EN 12767 (35 km/h)",
            Self::SeverityIndex => "severity index (historical)",
        }
    }

    /// The document that sets its limits, with edition, year and place.
    #[must_use]
    pub fn document(self) -> &'static str {
        match self {
            Self::Fmvss208 => "NHTSA, 49 CFR 571.208, S6, as of 2000 (advanced air bags)",
            Self::UnR94 => "UN Regulation 94, paragraph 5.2.1, as amended in 1998",
            Self::UnR137 => "UN Regulation 137, paragraph 5.2.1, 2016",
            Self::UnR95 => "UN Regulation 95, paragraph 5.2.1, as of 2023",
            Self::UnR135 => "UN Regulation 135, paragraph 5.3.1, 2016",
            Self::Fmvss214 => "NHTSA, 49 CFR 571.214, S7.2.5, S7.2.6 and S9.2, as of 2007",
            Self::UnR127 => {
                "UN Regulation 127, paragraph 5.2, 2013: 1000 over two thirds of the area that headforms hit, 1700 elsewhere"
            }
            Self::EuroNcapFullWidth | Self::EuroNcapMpdb | Self::EuroNcapSideBarrier | Self::EuroNcapSidePole => {
                "Euro NCAP, Assessment Protocol, Adult Occupant Protection, version 9.3, 2023"
            }
            Self::EuroNcapWhiplashLow | Self::EuroNcapWhiplashMedium | Self::EuroNcapWhiplashHigh => {
                "Euro NCAP, Assessment Protocol, Adult Occupant Protection, version 8.0.3, 2018, whiplash of front seats"
            }
            Self::IihsFrontal => {
                "IIHS, Moderate overlap frontal crashworthiness evaluation, guidelines for rating, 2017"
            }
            Self::Mash2016 | Self::Mash2016Supports => {
                "AASHTO, Manual for Assessing Safety Hardware, 2nd edition, 2016, Table 5-1, criteria F, H and I"
            }
            Self::Nchrp350 | Self::Nchrp350Supports => {
                "Ross and others, NCHRP Report 350, TRB, 1993, Table 5.1, criteria H and I"
            }
            Self::En1317Edition1998 => "CEN, EN 1317-2:1998 with A1:2006 (class C), impact severity levels",
            Self::En1317Edition2010 => "CEN, EN 1317-2:2010, impact severity levels",
            Self::En1317CushionHeadOn | Self::En1317CushionSide => "CEN, EN 1317-3:2010, impact severity levels",
            Self::En12767 | Self::En12767Slow => {
                "CEN, EN 12767:2007, levels of occupant safety; the edition of 2019 has classes A to E instead"
            }
            Self::SeverityIndex => "Gadd, SAE 660793, 1966; applied to the chest as to the head",
        }
    }

    /// Direction of impact of its test; none without a dummy.
    #[must_use]
    pub fn blow(self) -> Option<Blow> {
        match self {
            Self::Fmvss208
            | Self::UnR94
            | Self::UnR137
            | Self::EuroNcapFullWidth
            | Self::EuroNcapMpdb
            | Self::IihsFrontal => Some(Blow::Front),
            Self::UnR95 | Self::UnR135 | Self::Fmvss214 | Self::EuroNcapSideBarrier | Self::EuroNcapSidePole => {
                Some(Blow::Side)
            }
            Self::EuroNcapWhiplashLow | Self::EuroNcapWhiplashMedium | Self::EuroNcapWhiplashHigh => Some(Blow::Rear),
            Self::UnR127 => Some(Blow::OnFoot),
            _ => None,
        }
    }
}
