"""Every constant of the game, with its unit and where it comes from - and nothing else.

Lengths in px, speeds in px/tick, 40 ticks a second, y downwards. "W", "O", "N", "G" name the pages world, objects,
ninja, game of the specification. A product such as 12 * 0.35714285714285715 is written as the double it gives:
positions are compared to the last bit, so a "nicer" literal would be another game.
"""

TICKS_PER_SECOND = 40
LIFETIME = 3600  # ticks at the start of a level, G 1.1
GOLD_BONUS = 80  # ticks, G 1.1

# The grid, W 1. A ring of "missing" cells surrounds the 33 x 25 cells of the world, so that the neighbour of any cell
# of the world is one addition away; index 0 lies in that ring and means "no cell".
CELL = 24.0
HALF = 12.0
STRIDE = 35
GRID_CELLS = 35 * 27
RIGHT, DOWN, LEFT, UP = 0, 1, 2, 3  # direction numbers, O 1
WORLD_WIDTH = 792.0
WORLD_HEIGHT = 600.0

# Edge states, W 3.
OFF, INTERESTING, SOLID = 0, 1, 2

# The ninja, N 1.
RADIUS = 10.0
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
JUMP_VERTICAL = 3.0
LONGEST_JUMP = 30  # ticks
FATAL_IMPACT = 9.0
CRUSH = 80.0  # px², squared push
WALL_PROBE = 10.1

# Contact radii, O 8: the sum with the ninja's radius is what counts.
EXIT_RADIUS = 12.0
SWITCH_RADIUS = 6.0
GOLD_RADIUS = 6.0
PAD_RADIUS = 6.0
MINE_RADIUS = 4.0
GUARD_RADIUS = 6.0
DRONE_RADIUS = 9.0
AUTOMATIC_DOOR_RADIUS = 10.0
DOOR_SWITCH_RADIUS = 5.0

# Bounce block, O 8.3.
BLOCK_HALF = 9.600000000000001  # 12 * 0.8
BLOCK_SPRING = 0.05
BLOCK_DRAG = 0.99
BLOCK_SHARE = 0.8
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
ROCKET_PREPARE = 10  # ticks
ROCKET_SPEED = 3.4285714285714284  # 12 * 0.2857142857142857
ROCKET_ACCELERATION = 0.1
ROCKET_GROWTH = 1.1
ROCKET_TURN = 0.1

# Gauss turret, O 8.12.
TURRET_DELAY = 10  # ticks
TURRET_SHOT = 60.0
AIM_FAR, AIM_MID, AIM_NEAR = 0.03, 0.035, 0.05
AIM_FAR_SQUARED, AIM_MID_SQUARED, AIM_NEAR_SQUARED = 9216.0, 1764.0, 576.0  # px²

# Drones, O 8.13, 8.18, 8.19.
DRONE_SPEED = 0.8571428571428571  # 12 * 0.07142857142857142
LASER_PREPARE, LASER_BEAM, LASER_COOL = 30, 80, 40  # ticks
CHAINGUN_PREPARE, CHAINGUN_PAUSE, CHAINGUN_COOL = 35, 6, 60  # ticks

ROOT2 = 1.4142135623730951
INF = float("inf")
NAN = float("nan")
