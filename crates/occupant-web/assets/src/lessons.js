// Five small experiments. Each runs a case, then another beside it; `claims` are what the text says of the second, and a
// test holds the simulator to them.

const SEAT = "car.seats.driver.";
const BARE = { [`${SEAT}pretensioner`]: "0 mm", "car.bags.driver": "false" };

export const LESSONS = [
  {
    name: "slack",
    title: "Slack in the belt",
    question:
      "A thick coat leaves 10 cm of webbing loose. The car stops in 0.1 s from 50 km/h. What does that cost?",
    runs: [
      { say: "A tight belt", template: "driver", set: { ...BARE, [`${SEAT}slack`]: "0 mm" } },
      { say: "10 cm of slack", template: "driver", set: { ...BARE, [`${SEAT}slack`]: "100 mm" } },
    ],
    look: "Look at the plot of belt force: when does the belt begin to pull? Then at the scene from the side: how far does the head go?",
    answer:
      "The loose belt pulls later. By then the car has lost more of its speed and the body has not, so the same speed is taken off in less time and way: the head goes farther and its HIC rises. A pretensioner winds the slack in before the body has moved: set it back to 100 mm and compare again.",
    claims: { hic15: 1, "head_excursion.forward_m": 1 },
  },
  {
    name: "limiter",
    title: "The load limiter",
    question:
      "A limiter lets webbing out when the belt force reaches a bound. Is a higher bound, a stiffer belt, safer?",
    runs: [
      { say: "A bound of 3 kN", template: "driver", set: { [`${SEAT}limiter`]: "3 kN" } },
      { say: "A bound of 6 kN", template: "driver", set: { [`${SEAT}limiter`]: "6 kN" } },
    ],
    look: "Compare the deflection of the chest and the forward excursion of the head, both among the measures.",
    answer:
      "With 6 kN the head stays farther back, but the chest is pressed in more and decelerates harder. With 3 kN it is the other way round. A limiter trades room for load: how much room there is depends on the car, how much load is borne on the person. There is no best value for all.",
    claims: { chest_deflection: 1, "head_excursion.forward_m": -1 },
  },
  {
    name: "size",
    title: "Small and large people",
    question:
      "The same car, the same crash: a small woman and a large man at the wheel. Who goes farther forward?",
    runs: [
      {
        say: "A small woman (5th percentile)",
        template: "driver",
        set: { "body.preset": '"female05"' },
      },
      {
        say: "A large man (95th percentile)",
        template: "driver",
        set: { "body.preset": '"male95"' },
      },
    ],
    look: "Where does each sit? Which of them meets the bag first? Compare excursion, head and chest acceleration.",
    answer:
      "The same belt forces act on less than half of the mass: she is stopped in a shorter way and with a higher acceleration of head and chest. She also sits closer to the wheel. He has the mass to pull the webbing out of the limiter and goes farther. A restraint tuned to one of them is not tuned to the other.",
    claims: { chest_peak: -1, "head_excursion.forward_m": 1 },
  },
  {
    name: "head-restraint",
    title: "The head restraint",
    question:
      "The car is struck from behind. The head restraint is 2 cm behind the head, or 12 cm. Does it matter?",
    runs: [
      { say: "A gap of 2 cm", template: "rear", set: { [`${SEAT}head_gap`]: "20 mm" } },
      { say: "A gap of 12 cm", template: "rear", set: { [`${SEAT}head_gap`]: "120 mm" } },
    ],
    look: "Play it slowly: the seat pushes the chest forward while the head stays where it is. Compare NIC, a measure of this relative motion, and the moment in the neck.",
    answer:
      "With the wide gap the head has no support while the chest is already being pushed, and the neck takes up the difference: NIC roughly doubles and the head meets the restraint faster. Set the restraint close behind the head, as high as its top.",
    claims: { nic: 1, hic15: 1, nkm: 1 },
  },
  {
    name: "unbelted",
    title: "Without a belt",
    question: "“I have an air bag, so I need no belt.” Try it, then without the bag too.",
    runs: [
      { say: "Belt and air bag", template: "driver", set: {} },
      { say: "No belt, air bag alone", template: "driver", set: { [`${SEAT}belt`]: '"none"' } },
      {
        say: "Neither",
        template: "driver",
        set: { [`${SEAT}belt`]: '"none"', "car.bags.driver": "false" },
      },
    ],
    look: "Nothing slows the body until it meets the car: watch knees, chest and head, and when each begins to slow down. Read the caveats: what does the simulation itself say that it cannot tell?",
    answer:
      "Unbelted, the body keeps 50 km/h while the car stops, slides under or through the bag and strikes the car with what is left. The bag is made to work with the belt. Without either, the head strikes at full speed and its HIC is far beyond every limit. Figures marked with ! are not to be quoted: there the simulated body went where the model of the bag ends.",
    claims: { head_peak: 1, "head_excursion.forward_m": 1 },
  },
];
