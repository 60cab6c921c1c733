"""Cases in the words of the format, one for each thing that it can say; reading alone is tested on them."""

from __future__ import annotations

FOUR_BAR = """\
icsolve: 1                              # version of the format
title: Four-bar press
source: "where the problem stands"
units: {length: in, force: lbf}

points:
  A: [0, 0]
  D: [4, 0]
lengths: {AB: 1, BC: 3.5, CD: 2.5, DE: 1.5}
angles:  {AB: 60, CDE: 0}
near:    {C: [3.5, 2.4]}

joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {pin: [4, 1], at: D}

loads:
  P:   {force: 100, link: 4, at: E, angle: 180}
  T12: {torque: unknown, link: 2}

expect:
  w4/w2: {value: 0.49, within: 1%}
"""

SLIDER_CRANK = """\
icsolve: 1
units: {length: mm, force: N, torque: N*m}
points: {A: [0, 0], C: [unknown, 5 mm]}
lengths: {AB: 30, BC: 0.09 m}
angles: {AB: 1.2 rad}
near: {C: [10 cm, 0]}
joints:
  - {pin: [1, 2], at: A, mu: 0.2, radius: 4}
  - pin: [2, 3]
    at: B
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0, mu: 0.1, length: 20}
loads:
  P: {force: 2 kN, link: 4, at: C, slope: [-3, 4]}
  T12: {torque: unknown, link: 2, turns: cw}
motion: {link: 2, speed: 300 rpm, turns: cw}
expect:
  T12: 29.67 N*m cw
  I24: [-15.5, 2.25]
  I13: {toward: 90}
  I24-A: 3.104
  I12-I23: {value: 30, within: 0.5}
  w3: 77.36 cw
  v C on 4: 75 mm/s at 30 deg
  F34: 298.7
  F34x: -12
  F3-4@C: 298.7
  M14: 3 ccw
  h F32 A: 27.6
  rf A: {value: 0.7845, within: 0.2 %}
  P: {value: 200, erratum: "kN taken for N"}
"""

SLOT_AND_WORDS = """\
icsolve: 1
ground: frame
reconstructed: "the figure is lost"
points:
  O2: [0, 0]
  O4: [0, -3]
  A: [1, 1]
  C: [0.5, -0.5]
  G: {centroid: [O2, A]}
links: {rocker: [C]}
joints:
  - {pin: [frame, crank], at: O2}
  - {pin: [frame, rocker], at: O4}
  - {slot: [crank, rocker], at: A, along: [O4, C], through: C}
loads:
  W: {weight: 30, link: crank, at: G}
  M: {mass: 2 kg, link: crank, at: [0.1, 0.2]}
  S: {spring: 40, free: 0.3, link: crank, at: A, against: rocker, to: [2, 2]}
  Q: {force: [3, -4 kN], link: rocker, at: C, against: crank, turns_with: rocker}
  T: {torque: 5 ft-lb, link: rocker}
  U: {torque: {like: T, times: -1}, link: crank}
  V: {force: unknown, link: rocker, at: C, toward: A}
  X: {force: {like: V}, link: crank, at: A, away: O4}
motion: {point: A, link: crank, speed: 100, angle: 135}
gravity: 32.174 ft/s^2
expect:
  V: 12.5 push
  crank-rocker: {value: [0.9, 1.2], within: 1%}
  wrocker/wcrank: -.34
  Fcrank-rocker: 1e3
"""

GEARS = """\
icsolve: 1
points: {A: [0, 0], B: [3, 0], P: [1, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [1, 4], at: A}
  - {gears: [3, 4], teeth: [31, 57], carrier: 2, pressure angle: 20, diametral pitch: 16}
  - {gears: [3, 1], teeth: [31, -92], module: 2 mm}
  - {belt: [1, 4], radii: [3, 5], crossed: true, carrier: 2}
  - {roll: [2, 3], at: P, radii: [1.5, 0]}
  - {weld: [4, 5]}
  - {weld: [4, 6], at: P}
loads:
  H: {power: 1.5 hp, speed: 1500 rpm, link: 2, turns: cw, against: 4}
motion:
  - {link: 2, turns: ccw}
  - {link: 3, speed: -12}
"""

CAM_AND_BLACK_BOX = """\
icsolve: 1
points: {K: [1.39, 3.8], L: [1, 1]}
joints:
  - {contact: [2, 3], at: K, normal: 90 deg, mu: 0.13}
  - {centre: [2, 7], at: [1.06, -1.0]}
  - {centre: [1, 7], toward: 90}
  - {centre: [1, 2], at: L}
  - {centre: [1, 2], at: [1, 2]}
"""

AWKWARD_NAMES = """\
icsolve: 1
points:
  NO: [0, 0]
  B': [1, 0]
  A: [0, 1]
  12: [1, 1]
  1E3: [2, 2]
  O2: [5, 5]
lengths: {AB': 1.5, A'B': 2, O2-A: 7, NO-12: 1.4}
angles: {AB'A': 30, O2-A-B': 10}
joints:
  - {pin: [1, on], at: NO}
  - {pin: [on, 3'], at: 1E3}
  - {pin: [3', y], at: "B'"}
  - {pin: [y, 1], at: A'}
loads:
  ON: {torque: unknown, link: on}
  null: {force: .5, link: y, at: 12, angle: -.5e1}
"""

HELICAL = """\
icsolve: 1
points: {A: [0, 0], B: [3, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [1, 3], at: B}
  - {gears: [2, 3], teeth: [9, 12], normal pressure angle: 20, helix angle: 30, bearing span: 1}
  - {gears: [2, 3], teeth: [9, 12], transverse pressure angle: 20, helix angle: 30, normal module: 2 mm}
"""

PROFILES = """\
icsolve: 1
units: {length: mm, force: N}
points: {A: [0, 0], B: [40, 0], C: [20, 30], D: [0, 80], E: [60, 5], F: [100, 0], G: [200, 0], H: [300, 0]}
profile:
  2: {polygon: [A, B, [22, 31], C]}
  3: {knife: D}
  4: {arcs: [{centre: F, radius: 20, from: 90, to: E}, {centre: [110, 0], from: A, to: -30 deg, turns: cw}]}
  5: {roller: [100, 90], radius: 5 mm}
  6: {about: G, zero: [G, H], radii: {0: 20, 90: 25, 180: 30 mm, -90: 25}, turns: cw}
  7: {flat: H, along: 30}
  8: {circle: H, radius: 12}
  9: {flat: G, along: [D, G]}
joints:
  - {pin: [1, 2], at: A}
  - {contact: [2, 3]}
  - {contact: [5, 4], mu: 0.1}
  - {contact: [6, 7], normal: 80}
  - {contact: [8, 9]}
  - {slide: [3, 1], at: D, along: 90}
"""

IN_SPACE = """\
icsolve: 1
units: {length: in, force: lbf}
gravity: {size: 9.8 m/s^2, along: -y}
points:
  A: [0, 0, 0]
  B: [0, 0, 5 in]
  C: [1, -.5, 2e-1]
  G: [0, 0, 2.5]
  H: [6, 0, 2.5]
  K: {centroid: [A, C]}
joints:
  - {thrust: [1, 2], at: A, axis: z}
  - {radial: [1, 2], at: B, axis: [0, 0, 1]}
  - {hinge: [1, 3], at: H, axis: [A, B]}
  - gears: [2, 3]
    teeth: [31, 57]
    at: [G, H]
    axis: z
    normal pressure angle: 25
    helix angle: 30
    hand: left
  - {gears: [3, 1], teeth: 40, at: H, toward: -x, axis: -z, pressure angle: 20, module: 0.2}
  - {gears: [2, 1], teeth: 40, at: G, toward: A, axis: z, pressure angle: 20, diametral pitch: 8}
  - {ball: [2, 4], at: C}
  - {weld: [4, 5], at: K}
loads:
  P: {force: [1, -2, 3 kip], link: 4, at: K}
  Q: {force: unknown, link: 4, at: [1, 2, 3], toward: A}
  R: {force: {like: Q, times: -1}, link: 5, at: C, along: [0, 3, 4], against: 2}
  S: {spring: 40, free: 1, link: 4, at: C, against: 2, to: B}
  T: {torque: 5 ft-lb, link: 2, along: -z}
  U: {torque: [1, 2, 3], link: 3, against: 2}
  V: {power: 150 hp, speed: 1500 rpm, link: 2, along: [A, B]}
  W: {weight: 30, link: 4, at: K}
  X: {mass: 2 kg, link: 5, at: C}
  Y: {force: 3, link: 5, at: C, away: A}
expect:
  Q: 12.5 toward A
  T: 5 about -z
  F12@A: 3
  F12z@A: {value: 3, within: 1%}
  M13x: -4
  thrust F12@A: 2
  couple 2 F23: 7
  h F24 A: 1
  A-B: 5
"""

MORE_LOADS = """\
icsolve: 1
units: {length: mm, force: N}
points: {A: [0, 0], B: [10, 0], C: [{unknown: [0, 30]}, 5], D: [3, 8]}
lengths: {BD: {unknown: [5, 20], from: 10.6}}
angles: {AB: {unknown: [-20, 200 deg], from: 0}, ABD: unknown}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {slide: [3, 1], at: C, along: 0}
loads:
  S: {spring: 20 N*mm/rad, corner: ABD, free: 90, link: 3, against: 2}
  R: {spring: {like: S, times: 2}, corner: A-B, free: 1.2 rad, link: 2}
  P: {pressure: 8 MPa, bore: 50 mm, rod: 20, link: 3, at: C, angle: 0, against: 2}
  Q: {pressure: 80 bar, area: 19 cm^2, link: 3, at: [1, 2], toward: A, turns_with: 2}
  L: {distributed: 200 N/m, link: 2, from: A, to: B, angle: -90}
  M: {distributed: [0, 200 N/m], link: 2, from: A, to: B, slope: [1, 2], turns_with: 2}
expect:
  angles.AB: {value: 46.4, stability: stable, within: 1%}
  lengths.DB: 7
"""

DIRECTED = """\
icsolve: 1
points: {A: [0, 0], B: [10, 0], C: [10, 5]}
joints:
  - {pin: [1, 2], at: A, mu: 0.1, radius: 2}
  - {pin: [2, 3], at: B}
loads:
  P: {force: [unknown, unknown], link: 3, at: C, against: 2}
  W: {weight: 3, link: 2, at: B}
expect:
  P: {holds: [113, 287 N], within: 2}
  W: {holds: [null, 3]}
"""

ALL = {
    "more loads": MORE_LOADS,
    "directed": DIRECTED,
    "four bar": FOUR_BAR,
    "slider-crank": SLIDER_CRANK,
    "slot and words": SLOT_AND_WORDS,
    "gears": GEARS,
    "cam and black box": CAM_AND_BLACK_BOX,
    "awkward names": AWKWARD_NAMES,
    "helical": HELICAL,
    "profiles": PROFILES,
    "in space": IN_SPACE,
}
