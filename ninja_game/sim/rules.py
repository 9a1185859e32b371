"""Every constant of the game, with its unit and its source - and nothing else.

Lengths in px, speeds in px/tick, accelerations in px/tick², y downwards; factors, shares and directions have no unit.
"W", "O", "N", "G" name the pages world, objects, ninja, game of the specification. A product such as
12 * 0.35714285714285715 is written as the double it gives: positions are compared to the last bit, so a "nicer" literal
would be another game.

Rules copy these names when they are imported: assigning ``rules.GRAVITY`` later changes nothing. To try another number,
edit it here.
"""

RULES_VERSION = 1  # replays store it; every change of the world that changes any replay raises it

TICKS_PER_SECOND = 40
TICK_MS = 25  # real milliseconds per tick at normal speed: 1000 / TICKS_PER_SECOND, without a remainder
LIFETIME = 3600  # ticks at the start of a level, G 1.1
GOLD_BONUS = 80  # ticks, G 1.1

# Start of a ninja whose record has no usable place, px, O 2.1.
DEFAULT_SPAWN_X, DEFAULT_SPAWN_Y = 45.0, 70.0

# The grid, W 1. A ring of "missing" cells surrounds the 33 x 25 cells of the world, so that the neighbour of any cell
# of the world is one addition away; index 0 lies in that ring and means "no cell".
CELL = 24.0
HALF = 12.0
QUARTER = 6.0  # half of HALF: distance of a shallow slope's ends from its middle, W 2.2
GRID_COLUMNS, GRID_ROWS = 33, 25
STRIDE = 35
GRID_CELLS = STRIDE * (GRID_ROWS + 2)
RIGHT, DOWN, LEFT, UP = 0, 1, 2, 3  # direction numbers, O 1
WORLD_WIDTH = 792.0
WORLD_HEIGHT = 600.0

# Edge states, W 3.
OFF, INTERESTING, SOLID = 0, 1, 2

# The ninja, N 1.
RADIUS = 10.0  # also half the width and height of the box
GROUND_ACCELERATION = 0.15
AIR_ACCELERATION = 0.1
TOP_SPEED = 5.0
GRAVITY = 0.15
JUMP_GRAVITY = 0.025
DRAG = 0.99
CELEBRATION_DRAG = 0.8
WALL_FRICTION = 0.13
SKID_FRICTION = 0.92
STAND_FRICTION = 0.8
STAND_SPEED = 0.1
JUMP_VERTICAL = 3.0  # a jump's vertical factor; the horizontal one is 1, N 7.4
UPHILL_JUMP_Y = -0.7  # direction of a jump off a slope with the key against its normal, N 7.2
UPHILL_HELP = 0.5  # factor, no unit, N 7.2.1
WALL_HOP_Y = -0.5  # direction of a hop up the wall that the ninja holds on to; its x is the wall's normal, N 7.1
WALL_JUMP_X, WALL_JUMP_Y = 1.5, -0.7  # direction of a jump off a wall; x times the wall's normal, N 7.1
MAX_JUMP_TICKS = 30  # ticks
FATAL_IMPACT = 9.0  # px/tick against the floor's normal, N 6
FLOOR_ALLOWANCE = 2.0  # px/tick that a level floor subtracts from an impact; a slope subtracts less, by its normal, N 6
PARALLEL_FLOORS = 0.9  # two floor normals whose product is greater count as one, N 6.1
CRUSH = 80.0  # px², squared push
WALL_PROBE = 10.1  # px from the middle, N 1

# Kill impulses: the velocity that a death gives to the corpse, px/tick, O 8.8 to 8.19.
ZAP_IMPULSE = 10.0
TURRET_IMPULSE = 8.0
LASER_IMPULSE = 6.0
BULLET_IMPULSE = 5.0
THWUMP_UP_IMPULSE, THWUMP_DOWN_IMPULSE = -8.0, 6.0
THWUMP_SIDE_IMPULSE, THWUMP_SIDE_LIFT = 8.0, -4.0

THINK_PAUSE = 3  # ticks between two thinks; so one object thinks every fourth tick, O 2.4

# Contact radii, O 8: contacts compare the sum with the ninja's radius.
EXIT_RADIUS = 12.0
SWITCH_RADIUS = 6.0
GOLD_RADIUS = 6.0
PAD_RADIUS = 6.0
MINE_RADIUS = 4.0
GUARD_RADIUS = 6.0
DRONE_RADIUS = 9.0
ROCKET_RADIUS = 0.0  # the rocket's tip is a point
AUTOMATIC_DOOR_RADIUS = 10.0  # also half the width and height of the box
DOOR_SWITCH_RADIUS = 5.0

# Bounce block, O 8.3.
BLOCK_HALF = 9.600000000000001  # 12 * 0.8
BLOCK_SPRING = 0.05  # share of the way home that it moves in a tick, no unit
BLOCK_DRAG = 0.99  # factor per tick, no unit
BLOCK_SHARE = 0.8  # share of the overlap that moves the block
NINJA_SHARE = 0.2  # share of the overlap that moves the ninja
BLOCK_SLEEP = 40  # ticks without contact

PAD_STRENGTH = 5.142857142857142  # 12 * 0.42857142857142855, O 8.4
ONE_WAY_HALF = 12.0
AUTOMATIC_DOOR_OPEN = 5  # ticks after the last contact, O 8.7

# Thwump, O 8.8.
THWUMP_HALF = 9.0
THWUMP_FALL = 4.285714285714286  # 12 * 0.35714285714285715
THWUMP_RISE = 1.7142857142857142  # 12 * 0.14285714285714285
THWUMP_SIGHT = 38.0

GUARD_SPEED = 5.142857142857142  # O 8.10

# Homing launcher, O 8.11.
ROCKET_HEADING_X, ROCKET_HEADING_Y = 7.0, 6.0  # before the first shot, not normalised
ROCKET_PREPARE = 10  # ticks
ROCKET_SPEED = 3.4285714285714284  # 12 * 0.2857142857142857
ROCKET_ACCELERATION = 0.1  # px/tick²
ROCKET_GROWTH = 1.1  # factor of the acceleration per tick, no unit
ROCKET_TURN = 0.1  # factor of the sideways part added to the heading, no unit

# Gauss turret, O 8.12.
TURRET_DELAY = 10  # ticks
TURRET_SHOT = 60.0  # counted down to the shot, by the crosshair's distance:
NEAR_STEP, NEAR_CYCLE = 2.0, 4  # near: 2 + tick mod 4
MID_STEP, MID_CYCLE = 1.0, 2  # middle: 1 + tick mod 2
FAR_STEP = 0.5  # farther, up to AIM_FAR_SQUARED; beyond it the count stands
AIM_FAR, AIM_MID, AIM_NEAR = 0.03, 0.035, 0.05  # share of the distance that the crosshair moves in a tick, no unit
AIM_FAR_SQUARED, AIM_MID_SQUARED, AIM_NEAR_SQUARED = 9216.0, 1764.0, 576.0  # px²

# Drones, O 8.13, 8.18, 8.19.
DRONE_SPEED = 0.8571428571428571  # 12 * 0.07142857142857142; multiplied by one of the four below
ZAP_PACE, LASER_PACE, CHAINGUN_PACE, CHASE_PACE = 2.0, 0.5, 0.75, 2.0
DRONE_END_X, DRONE_END_Y = 4.0, 5.0  # end of a beam that meets nothing, as long as none has met anything, px
LASER_PREPARE, LASER_BEAM, LASER_COOL = 30, 80, 40  # ticks
CHAINGUN_PREPARE, CHAINGUN_PAUSE, CHAINGUN_COOL = 35, 6, 60  # ticks
BURST_SHOTS, BURST_SHOTS_CYCLE = 4, 5  # number of a burst's last shot: 4 + tick mod 5
BURST_SPREAD, BURST_SPREAD_CYCLE = 0.1, 3  # width of a burst's sweep: 0.1 + 0.1 * (1 + tick mod 3)

NEVER = 100_000_000.0  # crossing of a grid line by a parallel ray, px along the ray, W 7.1
ROOT2 = 1.4142135623730951
ROOT5 = 2.23606797749979
INF = float("inf")
NAN = float("nan")
