"""The drawing of the generic head: its vertices, triangles and features, and how vertices outside all features follow
them. Tables only; author_generic_head.py makes generic_head.gltf of them.

The shape is our own, after adult anthropometric proportions, with the vertex roles of CANDIDE and the 68 landmarks of
iBUG. glTF frame: x to the right of the picture (the subject's left), y up, z toward the viewer, 1 unit = the distance
between the eye centres, origin midway between the eyes in x and y and in mid-head in z. Sigmas are in the same unit.
The right half is the exact mirror image of the left: SIDE, TRIANGLES and FOLLOW list one of them, and {} in a name
stands for the subject's "left" or "right".
"""

# name, iBUG-68 landmark or None, y, z
MIDLINE = [
    ("chin", 8, -1.85, 1.0),
    ("nasion", 27, 0.065, 1.235),
    ("nose_bridge_upper", 28, -0.175, 1.375),
    ("nose_bridge_lower", 29, -0.385, 1.525),
    ("nose_tip", 30, -0.565, 1.615),
    ("subnasale", 33, -0.775, 1.395),
    ("upper_lip_mid", 51, -1.018, 1.36),
    ("lower_lip_mid", 57, -1.325, 1.28),
    ("inner_upper_lip_mid", 62, -1.108, 1.325),
    ("inner_lower_lip_mid", 66, -1.143, 1.29),
    ("hairline_mid", None, 1.20, 1.03),
    ("forehead_upper", None, 0.93, 1.16),
    ("forehead_mid", None, 0.65, 1.225),
    ("glabella", None, 0.32, 1.26),
    ("philtrum", None, -0.895, 1.335),
    ("labiomental_crease", None, -1.45, 1.19),
    ("chin_boss", None, -1.645, 1.205),
]

# name, landmark on the subject's right or None, |x|, y, z
SIDE = [
    ("jaw_{}_0", 0, 1.095, -0.02, 0.06),
    ("jaw_{}_1", 1, 1.08, -0.28, 0.06),
    ("jaw_{}_2", 2, 1.05, -0.54, 0.085),
    ("jaw_{}_3", 3, 1.0, -0.8, 0.13),
    ("jaw_{}_4", 4, 0.915, -1.07, 0.21),
    ("jaw_{}_5", 5, 0.74, -1.4, 0.42),
    ("jaw_{}_6", 6, 0.57, -1.57, 0.62),
    ("jaw_{}_7", 7, 0.325, -1.76, 0.87),
    ("brow_{}_outer", 17, 0.895, 0.262, 0.8),
    ("brow_{}_outer_mid", 18, 0.785, 0.36, 0.98),
    ("brow_{}_mid", 19, 0.63, 0.412, 1.105),
    ("brow_{}_inner_mid", 20, 0.44, 0.402, 1.195),
    ("brow_{}_inner", 21, 0.228, 0.372, 1.245),
    ("nostril_{}_outer", 31, 0.21, -0.72, 1.295),
    ("nostril_{}_inner", 32, 0.12, -0.77, 1.36),
    ("eye_{}_outer", 36, 0.715, -0.031, 0.86),
    ("upper_lid_{}_outer", 37, 0.592, 0.069, 1.0),
    ("upper_lid_{}_inner", 38, 0.43, 0.073, 1.03),
    ("eye_{}_inner", 39, 0.266, -0.034, 0.975),
    ("lower_lid_{}_inner", 40, 0.418, -0.041, 1.0),
    ("lower_lid_{}_outer", 41, 0.579, -0.037, 0.97),
    ("mouth_corner_{}", 48, 0.4, -1.1, 1.11),
    ("upper_lip_{}_outer", 49, 0.25, -1.012, 1.27),
    ("upper_lip_{}_inner", 50, 0.115, -0.992, 1.355),
    ("lower_lip_{}_inner", 58, 0.135, -1.31, 1.26),
    ("lower_lip_{}_outer", 59, 0.262, -1.255, 1.195),
    ("inner_mouth_corner_{}", 60, 0.341, -1.1, 1.135),
    ("inner_upper_lip_{}", 61, 0.122, -1.104, 1.285),
    ("inner_lower_lip_{}", 67, 0.122, -1.139, 1.27),
    ("pupil_{}", None, 0.5, 0.012, 1.03),
    ("upper_lid_crease_{}", None, 0.51, 0.215, 1.085),
    ("orbit_{}_outer", None, 0.89, 0.06, 0.76),
    ("infraorbital_{}", None, 0.52, -0.26, 1.0),
    ("nasojugal_{}", None, 0.25, -0.23, 1.085),
    ("nose_wing_{}", None, 0.285, -0.6, 1.225),
    ("nasolabial_{}", None, 0.42, -0.83, 1.09),
    ("mouth_side_{}", None, 0.57, -1.15, 0.98),
    ("mentolabial_{}", None, 0.3, -1.48, 1.095),
    ("cheekbone_{}", None, 0.79, -0.38, 0.82),
    ("cheek_{}", None, 0.74, -0.85, 0.79),
    ("temple_{}", None, 1.06, 0.42, 0.28),
    ("forehead_{}", None, 0.50, 0.72, 1.115),
    ("hairline_{}_outer", None, 0.92, 0.78, 0.50),
    ("hairline_{}_inner", None, 0.52, 1.08, 0.88),
]

# The subject's left half, counter-clockwise seen from the front.
TRIANGLES = """
hairline_mid forehead_upper hairline_{}_inner
forehead_upper forehead_{} hairline_{}_inner
forehead_upper forehead_mid forehead_{}
forehead_{} hairline_{}_outer hairline_{}_inner
forehead_mid glabella brow_{}_inner
forehead_mid brow_{}_inner brow_{}_inner_mid
forehead_mid brow_{}_inner_mid forehead_{}
brow_{}_mid forehead_{} brow_{}_inner_mid
brow_{}_mid hairline_{}_outer forehead_{}
brow_{}_outer_mid hairline_{}_outer brow_{}_mid
brow_{}_outer_mid temple_{} hairline_{}_outer
brow_{}_outer temple_{} brow_{}_outer_mid
jaw_{}_0 temple_{} brow_{}_outer
jaw_{}_0 brow_{}_outer orbit_{}_outer
nasion brow_{}_inner glabella
nasion eye_{}_inner brow_{}_inner
brow_{}_inner eye_{}_inner upper_lid_{}_inner
brow_{}_inner_mid brow_{}_inner upper_lid_{}_inner
brow_{}_inner_mid upper_lid_{}_inner upper_lid_crease_{}
brow_{}_mid brow_{}_inner_mid upper_lid_crease_{}
brow_{}_outer_mid brow_{}_mid upper_lid_crease_{}
brow_{}_outer_mid upper_lid_crease_{} upper_lid_{}_outer
upper_lid_{}_outer upper_lid_crease_{} upper_lid_{}_inner
brow_{}_outer brow_{}_outer_mid upper_lid_{}_outer
brow_{}_outer upper_lid_{}_outer orbit_{}_outer
eye_{}_outer orbit_{}_outer upper_lid_{}_outer
eye_{}_outer upper_lid_{}_outer pupil_{}
upper_lid_{}_outer upper_lid_{}_inner pupil_{}
upper_lid_{}_inner eye_{}_inner pupil_{}
eye_{}_inner lower_lid_{}_inner pupil_{}
lower_lid_{}_inner lower_lid_{}_outer pupil_{}
lower_lid_{}_outer eye_{}_outer pupil_{}
eye_{}_outer cheekbone_{} orbit_{}_outer
eye_{}_outer infraorbital_{} cheekbone_{}
eye_{}_outer lower_lid_{}_outer infraorbital_{}
lower_lid_{}_inner infraorbital_{} lower_lid_{}_outer
lower_lid_{}_inner nasojugal_{} infraorbital_{}
eye_{}_inner nasojugal_{} lower_lid_{}_inner
jaw_{}_0 orbit_{}_outer jaw_{}_1
jaw_{}_1 orbit_{}_outer cheekbone_{}
jaw_{}_1 cheekbone_{} jaw_{}_2
jaw_{}_2 cheekbone_{} cheek_{}
jaw_{}_2 cheek_{} jaw_{}_3
jaw_{}_3 cheek_{} jaw_{}_4
jaw_{}_4 cheek_{} mouth_side_{}
jaw_{}_4 mouth_side_{} jaw_{}_5
jaw_{}_5 mouth_side_{} jaw_{}_6
jaw_{}_6 mouth_side_{} mentolabial_{}
jaw_{}_6 mentolabial_{} jaw_{}_7
chin_boss jaw_{}_7 mentolabial_{}
chin jaw_{}_7 chin_boss
nasion nose_bridge_upper eye_{}_inner
nose_bridge_upper nasojugal_{} eye_{}_inner
nose_bridge_upper nose_bridge_lower nasojugal_{}
nose_bridge_lower nose_wing_{} nasojugal_{}
nose_bridge_lower nose_tip nose_wing_{}
nose_tip nostril_{}_outer nose_wing_{}
nose_tip nostril_{}_inner nostril_{}_outer
nose_tip subnasale nostril_{}_inner
infraorbital_{} nasojugal_{} nose_wing_{}
infraorbital_{} nose_wing_{} cheekbone_{}
nose_wing_{} nasolabial_{} cheekbone_{}
nasolabial_{} cheek_{} cheekbone_{}
nasolabial_{} mouth_side_{} cheek_{}
nostril_{}_outer nasolabial_{} nose_wing_{}
nostril_{}_outer upper_lip_{}_outer nasolabial_{}
nostril_{}_outer nostril_{}_inner upper_lip_{}_outer
nostril_{}_inner upper_lip_{}_inner upper_lip_{}_outer
philtrum upper_lip_{}_inner nostril_{}_inner
subnasale philtrum nostril_{}_inner
upper_lip_mid upper_lip_{}_inner philtrum
mouth_corner_{} nasolabial_{} upper_lip_{}_outer
mouth_corner_{} mouth_side_{} nasolabial_{}
mouth_corner_{} lower_lip_{}_outer mouth_side_{}
lower_lip_{}_outer mentolabial_{} mouth_side_{}
lower_lip_{}_inner mentolabial_{} lower_lip_{}_outer
labiomental_crease mentolabial_{} lower_lip_{}_inner
lower_lip_mid labiomental_crease lower_lip_{}_inner
labiomental_crease chin_boss mentolabial_{}
upper_lip_mid inner_upper_lip_mid upper_lip_{}_inner
inner_upper_lip_mid inner_upper_lip_{} upper_lip_{}_inner
upper_lip_{}_outer upper_lip_{}_inner inner_upper_lip_{}
upper_lip_{}_outer inner_upper_lip_{} inner_mouth_corner_{}
mouth_corner_{} upper_lip_{}_outer inner_mouth_corner_{}
mouth_corner_{} inner_mouth_corner_{} lower_lip_{}_outer
lower_lip_{}_outer inner_mouth_corner_{} inner_lower_lip_{}
lower_lip_{}_inner lower_lip_{}_outer inner_lower_lip_{}
inner_lower_lip_mid lower_lip_{}_inner inner_lower_lip_{}
lower_lip_mid lower_lip_{}_inner inner_lower_lip_mid
inner_mouth_corner_{} inner_upper_lip_{} inner_lower_lip_{}
inner_upper_lip_mid inner_lower_lip_{} inner_upper_lip_{}
inner_upper_lip_mid inner_lower_lip_mid inner_lower_lip_{}
"""

# The border from the subject's right ear over the hairline to the left ear; the jaw closes it.
HAIRLINE = ["temple_right", "hairline_right_outer", "hairline_right_inner", "hairline_mid",
            "hairline_left_inner", "hairline_left_outer", "temple_left"]

# name, closed, controls, [(landmark, 12 s)]
FEATURES = [
    ("mouth_outer", True, 10, [(48 + k, 10 * k) for k in range(12)]),
    ("mouth_inner", True, 8, [(60 + k, 12 * k) for k in range(8)]),
    ("brow_right", False, 4, [(17 + k, 3 * k) for k in range(5)]),
    ("brow_left", False, 4, [(22 + k, 3 * k) for k in range(5)]),
    ("upper_lid_right", False, 2, [(37, 4), (38, 8)]),
    ("upper_lid_left", False, 2, [(43, 4), (44, 8)]),
    ("lower_lid_right", False, 2, [(40, 4), (41, 8)]),
    ("lower_lid_left", False, 2, [(46, 4), (47, 8)]),
    ("pupil_right", False, 1, [("pupil_right", 0)]),
    ("pupil_left", False, 1, [("pupil_left", 0)]),
]
CONTROL_MIRROR = ([(5 - i) % 10 for i in range(10)] + [10 + (4 - i) % 8 for i in range(8)] +
                  [25, 24, 23, 22, 21, 20, 19, 18] + [29, 28, 27, 26] + [33, 32, 31, 30] + [35, 34])
UPPER_CONTROLS = {1, 2, 3, 4, 11, 12, 13}  # strictly of the upper lip; 0, 5, 10, 14 are the corners
LOWER_CONTROLS = {6, 7, 8, 9, 15, 16, 17}

UPPER_LIP = [48, 49, 50, 51, 52, 53, 54]
LOWER_LIP = [54, 55, 56, 57, 58, 59, 48]
LOWER_LIP_INSIDE = [55, 56, 57, 58, 59]
BROWS = [17, 18, 19, 20, 21, 22, 23, 24, 25, 26]
UPPER_LIDS = {"left": [43, 44], "right": [37, 38]}
LOWER_LIDS = {"left": [46, 47], "right": [40, 41]}

# How vertices outside all features follow: name -> [(sources, sigma of the mean, sigma of the falloff, factor)].
# Sources of both sides count as one feature here, so that two raised brows lift the glabella once, not twice.
FOLLOW = {
    "philtrum": [(UPPER_LIP, 0.20, 0.22, 1.0)],
    "subnasale": [(UPPER_LIP, 0.20, 0.22, 0.5)],
    "nostril_{}_inner": [(UPPER_LIP, 0.20, 0.22, 0.5)],
    "nostril_{}_outer": [(UPPER_LIP, 0.20, 0.25, 0.6)],
    "nose_wing_{}": [(UPPER_LIP, 0.25, 0.30, 0.5)],
    "nasolabial_{}": [(UPPER_LIP, 0.25, 0.40, 0.9)],
    "infraorbital_{}": [(UPPER_LIP, 0.35, 0.45, 0.5), ("lower_lid", 0.12, 0.15, 1.0)],
    "cheekbone_{}": [(UPPER_LIP, 0.35, 0.45, 0.7)],
    "mouth_side_{}": [(UPPER_LIP + LOWER_LIP_INSIDE, 0.16, 0.36, 1.0)],
    "cheek_{}": [(UPPER_LIP + LOWER_LIP_INSIDE, 0.25, 0.42, 1.0)],
    "labiomental_crease": [(LOWER_LIP, 0.25, 0.65, 1.0)],
    "mentolabial_{}": [(LOWER_LIP, 0.25, 0.65, 1.0)],
    "chin_boss": [(LOWER_LIP_INSIDE, 0.35, 0.65, 1.0)],
    "chin": [(LOWER_LIP_INSIDE, 0.40, 0.75, 1.0)],
    "jaw_{}_7": [(LOWER_LIP_INSIDE, 0.40, 0.75, 1.0)],
    "jaw_{}_6": [(LOWER_LIP_INSIDE, 0.40, 0.75, 0.95)],
    "jaw_{}_5": [(LOWER_LIP_INSIDE, 0.40, 0.75, 0.8)],
    "jaw_{}_4": [(LOWER_LIP_INSIDE, 0.40, 0.75, 0.45)],
    "glabella": [(BROWS, 0.25, 0.27, 1.0)],
    "nasion": [(BROWS, 0.25, 0.27, 0.4)],
    "forehead_mid": [(BROWS, 0.25, 0.30, 1.0)],
    "forehead_upper": [(BROWS, 0.25, 0.30, 1.0)],
    "forehead_{}": [(BROWS, 0.20, 0.30, 1.0)],
    "orbit_{}_outer": [(BROWS, 0.20, 0.25, 0.6)],
    "upper_lid_crease_{}": [(BROWS, 0.20, 0.25, 0.6), ("upper_lid", 0.12, 0.12, 0.4)],
}
