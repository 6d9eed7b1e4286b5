// Colours of the scene.

/** Of the runs; the style sheet has the same as --run-0 to --run-3. */
export const RUNS = [0x2f6fb3, 0xd9730d, 0x2f9e63, 0x8b6fc9];

export const TONES = { skin: 0xe3b592, shirt: 0x5f8fbf, trousers: 0x6a7280 };
/** The clothes of the other runs, from the second on. */
export const OTHER_TONES = [
  { skin: 0xf0b27a, shirt: 0xd9730d, trousers: 0xa85c14 },
  { skin: 0xcfe3c4, shirt: 0x2f9e63, trousers: 0x216f46 },
  { skin: 0xd9cdef, shirt: 0x8b6fc9, trousers: 0x5f4a93 },
];

export const TAUT = 0xc2410c;
export const SLACK = 0x8a8a8a;
export const CONTACT = 0xbe123c;
export const BELT_FORCE = 0xea8a00;

/** Of surfaces, by material. */
export const MATERIALS = [
  0x5a8cbf, 0xbf9966, 0x8ca673, 0x99bfcc, 0xb38099, 0x73737f, 0xccbf80, 0x80b3a6,
];
