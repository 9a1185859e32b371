"""The rules that ``change_rules.py`` breaks, one at a time: constants, strictness, order, omitted quirks."""

from __future__ import annotations

from typing import NamedTuple


class Change(NamedTuple):
    """One line of a file under ``ninja_game/sim``, and what it becomes."""

    name: str
    file: str
    old: str
    new: str


CHANGES = (
    # Constants.
    Change("gravity", "rules.py", "\nGRAVITY = 0.15", "\nGRAVITY = 0.150000001"),
    Change("jump-gravity", "rules.py", "JUMP_GRAVITY = 0.025", "JUMP_GRAVITY = 0.026"),
    Change("drag", "rules.py", "\nDRAG = 0.99", "\nDRAG = 0.991"),
    Change("celebration-drag", "rules.py", "CELEBRATION_DRAG = 0.8", "CELEBRATION_DRAG = 0.9"),
    Change("air-acceleration", "rules.py", "AIR_ACCELERATION = 0.1", "AIR_ACCELERATION = 0.11"),
    Change("wall-friction", "rules.py", "WALL_FRICTION = 0.13", "WALL_FRICTION = 0.12"),
    Change("skid-friction", "rules.py", "SKID_FRICTION = 0.92", "SKID_FRICTION = 0.93"),
    Change("stand-friction", "rules.py", "STAND_FRICTION = 0.8", "STAND_FRICTION = 0.9"),
    Change("longest-jump", "rules.py", "LONGEST_JUMP = 30", "LONGEST_JUMP = 29"),
    Change("fatal-impact", "rules.py", "FATAL_IMPACT = 9.0", "FATAL_IMPACT = 9.5"),
    Change("crush", "rules.py", "CRUSH = 80.0", "CRUSH = 95.0"),
    Change("wall-probe", "rules.py", "WALL_PROBE = 10.1", "WALL_PROBE = 10.2"),
    Change("pad-strength", "rules.py", "PAD_STRENGTH = 5.142857142857142 ", "PAD_STRENGTH = 5.142857142857143 "),
    Change("thwump-fall", "rules.py", "THWUMP_FALL = 4.285714285714286", "THWUMP_FALL = 4.285714285714285"),
    Change("block-half", "rules.py", "BLOCK_HALF = 9.600000000000001", "BLOCK_HALF = 9.61"),
    Change("rocket-turn", "rules.py", "ROCKET_TURN = 0.1", "ROCKET_TURN = 0.11"),
    Change("gold-radius", "rules.py", "GOLD_RADIUS = 6.0", "GOLD_RADIUS = 7.0"),
    Change("mine-radius", "rules.py", "MINE_RADIUS = 4.0", "MINE_RADIUS = 4.5"),
    Change("laser-beam", "rules.py", "LASER_BEAM, LASER_COOL = 30, 80, 40", "LASER_BEAM, LASER_COOL = 30, 79, 40"),
    Change("default-spawn", "rules.py", "DEFAULT_SPAWN_X, DEFAULT_SPAWN_Y = 45.0, 70.0", "DEFAULT_SPAWN_X, DEFAULT_SPAWN_Y = 45.0, 71.0"),
    Change("jump-vertical", "rules.py", "JUMP_VERTICAL = 3.0", "JUMP_VERTICAL = 3.1"),
    Change("uphill-help-factor", "rules.py", "UPHILL_HELP = 0.5", "UPHILL_HELP = 0.6"),
    Change("wall-hop-y", "rules.py", "WALL_HOP_Y = -0.5", "WALL_HOP_Y = -0.6"),
    Change("wall-jump-x", "rules.py", "WALL_JUMP_Y = 1.5, -0.7", "WALL_JUMP_Y = 1.4, -0.7"),
    Change("wall-jump-y", "rules.py", "WALL_JUMP_Y = 1.5, -0.7", "WALL_JUMP_Y = 1.5, -0.8"),
    Change("floor-allowance", "rules.py", "FLOOR_ALLOWANCE = 2.0", "FLOOR_ALLOWANCE = 1.9"),
    Change("parallel-floors", "rules.py", "PARALLEL_FLOORS = 0.9", "PARALLEL_FLOORS = 0.95"),
    Change("ninja-share", "rules.py", "NINJA_SHARE = 0.2", "NINJA_SHARE = 0.21"),
    Change("turret-middle-step", "rules.py", "MID_STEP, MID_CYCLE = 1.0, 2", "MID_STEP, MID_CYCLE = 1.0, 3"),
    Change("turret-far-step", "rules.py", "FAR_STEP = 0.5", "FAR_STEP = 0.6"),
    Change("zap-pace", "rules.py", "ZAP_PACE, LASER_PACE, CHAINGUN_PACE, CHASE_PACE = 2.0, 0.5, 0.75, 2.0", "ZAP_PACE, LASER_PACE, CHAINGUN_PACE, CHASE_PACE = 2.1, 0.5, 0.75, 2.0"),
    Change("laser-pace", "rules.py", "CHASE_PACE = 2.0, 0.5, 0.75, 2.0", "CHASE_PACE = 2.0, 0.6, 0.75, 2.0"),
    Change("chaingun-pace", "rules.py", "CHASE_PACE = 2.0, 0.5, 0.75, 2.0", "CHASE_PACE = 2.0, 0.5, 0.8, 2.0"),
    Change("chase-pace", "rules.py", "CHASE_PACE = 2.0, 0.5, 0.75, 2.0", "CHASE_PACE = 2.0, 0.5, 0.75, 2.1"),
    Change("burst-spread", "rules.py", "BURST_SPREAD_CYCLE = 0.1, 3", "BURST_SPREAD_CYCLE = 0.2, 3"),
    Change("burst-spread-cycle", "rules.py", "BURST_SPREAD_CYCLE = 0.1, 3", "BURST_SPREAD_CYCLE = 0.1, 2"),
    Change("automatic-door-open", "rules.py", "AUTOMATIC_DOOR_OPEN = 5", "AUTOMATIC_DOOR_OPEN = 6"),
    # Grid, tiles, collision.
    Change("edge-under-the-surface", "collision/tiles.py", "OFF, INTERESTING, OFF]", "OFF, INTERESTING, SOLID]"),
    Change("thin-faces", "collision/tiles.py", "(shape == THIN_22 and side in (0, 2))", "(shape == THIN_22 and side == 4)"),
    Change("order-of-the-nine-cells", "objects/dispatch.py", "STRIDE, STRIDE + 1, STRIDE - 1, -1", "STRIDE, STRIDE - 1, STRIDE + 1, -1"),
    Change("keep-next-link", "grid.py", "    o.next = 0\n    o.prev = 0\n", "    o.prev = 0\n"),
    Change("keep-place-in-the-list", "grid.py", "    if cell == o.cell:\n        return 0\n", "    if cell == o.cell and cell == 0:\n        return 0\n"),
    Change("vertical-first", "collision/circle.py", "    dx = n.x - cx\n", "    dx = n.prev_x - cx\n"),
    Change("diagonal-needs-both-overlaps", "collision/circle.py", "oy > 0.0 and ox > 0.0 and kind_v", "oy > 0.0 and ox > 1.0 and kind_v"),
    Change("behind-the-surface", "collision/circle_contacts.py", "RADIUS - abs((n.x - ax) * nx + (n.y - ay) * ny)", "RADIUS - ((n.x - ax) * nx + (n.y - ay) * ny)"),
    Change("half-both-overlaps", "collision/circle_own_tile.py", "push_from_tile(w, ox, oy, ox / m, oy / m)", "push_from_tile(w, -ox, oy, -ox / m, oy / m)"),
    Change("exit-tie", "collision/circle_own_tile.py", "    if ox < oy:\n        hx", "    if ox <= oy:\n        hx"),
    Change("convex-ray-behind", "collision/ray_shapes.py", "t = t2 if t2 < t1 else t1", "t = t1 if t2 < 0.0 else t2"),
    Change("ray-corner-order", "collision/rays.py", "        if tx < ty:\n            t = tx", "        if tx <= ty:\n            t = tx"),
    Change("box-pulls-back", "collision/box.py", "        a = ox if dx < 0.0 else -ox\n", "        a = -ox if dx < 0.0 else ox\n"),
    # The ninja.
    Change("ceiling-is-no-floor", "ninja/contact_response.py", "    elif my < 0.0:", "    elif my != 0.0:"),
    Change("third-floor-contact", "ninja/contact_response.py", "        if n.floor_contacts == 0:", "        if n.floor_contacts != 1:"),
    Change("floor-normal-kept", "ninja/tick.py", "if not (n.first_floor_x == n.floor_x and n.first_floor_y == n.floor_y):", "if n.floor_contacts:"),
    Change("probe-without-wall-only", "ninja/tick.py", "if n.in_air and not n.near_wall:", "if n.in_air:"),
    Change("fall-needs-air", "ninja/tick.py", "    if n.was_in_air:\n", "    if n.floor_contacts:\n"),
    Change("jump-drops-opposing-speed", "ninja/control.py", "    if (n.y - n.prev_y) * jy < 0.0:\n        n.prev_y = n.y\n", ""),
    Change("wall-hop", "ninja/control.py", "if state == SLIDING and towards < 0.0:", "if state == SLIDING and towards > 0.0:"),
    Change("slide-needs-downward-speed", "ninja/control.py", "elif vy > 0.0 and towards < 0.0:", "elif towards < 0.0:"),
    Change("uphill-jump", "rules.py", "UPHILL_JUMP_Y = -0.7", "UPHILL_JUMP_Y = -0.8"),
    Change("uphill-help", "ninja/control.py", "        elif direction * floor_x < 0.0:\n            run_uphill", "        elif direction * floor_x < -9.0:\n            run_uphill"),
    Change("top-speed-strict", "ninja/control.py", "    a = vx + n.direction * AIR_ACCELERATION\n    if abs(a) < TOP_SPEED:", "    a = vx + n.direction * AIR_ACCELERATION\n    if abs(a) < TOP_SPEED + 0.1:"),
    # Schedule, death, win.
    Change("newest-first", "schedule.py", "    w.think_cursor = slot\n\n\n@fast\ndef end_think", "    w.think_cursor = w.think_cursor or slot\n\n\n@fast\ndef end_think"),
    Change("think-every-fourth", "rules.py", "THINK_PAUSE = 3", "THINK_PAUSE = 2"),
    Change("think-counter-stands", "world.py", "    if w.think_cursor:\n        if w.think_counter", "    if w.think_cursor or w.think_counter:\n        if w.think_counter"),
    Change("idle-turret", "death.py", "            o.think = TURRET_WAITING\n            end_think(w, o, slot)\n", "            o.think = TURRET_WAITING\n"),
    Change("idle-guard", "death.py", "            o.routine = GUARD_IDLE\n            end_update(w, o, slot)\n", "            o.routine = GUARD_IDLE\n"),
    Change("idle-doors", "death.py", "        elif kind == kinds.DOOR:\n            grid_remove(w, o)\n", ""),
    Change("contact-pass-off", "death.py", "    w.contacts_off = 1\n", ""),
    # Deaths and events: what they tell.
    Change("zap-impulse", "rules.py", "ZAP_IMPULSE = 10.0", "ZAP_IMPULSE = 11.0"),
    Change("turret-impulse", "rules.py", "TURRET_IMPULSE = 8.0", "TURRET_IMPULSE = 7.0"),
    Change("laser-impulse", "rules.py", "LASER_IMPULSE = 6.0", "LASER_IMPULSE = 5.0"),
    Change("bullet-impulse", "rules.py", "BULLET_IMPULSE = 5.0", "BULLET_IMPULSE = 6.0"),
    Change("thwump-up-impulse", "rules.py", "THWUMP_DOWN_IMPULSE = -8.0, 6.0", "THWUMP_DOWN_IMPULSE = 8.0, 6.0"),
    Change("thwump-side-lift", "rules.py", "THWUMP_SIDE_LIFT = 8.0, -4.0", "THWUMP_SIDE_LIFT = 8.0, 4.0"),
    Change("mine-impulse", "objects/mine.py", "slot, -dx, -dy,", "slot, dx, dy,"),
    Change("mine-cause", "objects/mine.py", "kill(w, EXPLOSIVE,", "kill(w, 0,"),
    Change("killer-forgotten", "objects/thwump.py", "kill(w, ELECTRIC, slot, 0.0, THWUMP_DOWN", "kill(w, ELECTRIC, 0, 0.0, THWUMP_DOWN"),
    Change("thwump-lands-unheard", "objects/thwump.py", "            emit(w, THWUMP_LANDED, slot, o.x, o.y, o.face_x, o.face_y)\n", ""),
    Change("gold-place-swapped", "objects/gold.py", "emit(w, GOLD_TAKEN, slot, o.x, o.y,", "emit(w, GOLD_TAKEN, slot, o.y, o.x,"),
    # Objects.
    Change("block-wakes", "objects/bounce_block.py", "    o.counter = 0\n    if not", "    if not"),
    Change("pad-plane", "objects/launch_pad.py", "        if not u * o.face_x + v * o.face_y < 0.0:", "        if True:"),
    Change("pad-up-twice", "objects/launch_pad.py", "            if o.face_y < 0.0:", "            if o.face_y < -0.9:"),
    Change("one-way-was-outside", "objects/one_way.py", "            gap = n.prev_y - face * RADIUS - (o.y + face * ONE_WAY_HALF)\n            if 0.0 <= gap * face:", "            gap = n.prev_y - face * RADIUS - (o.y + face * ONE_WAY_HALF)\n            if gap == gap:"),
    Change("trap-door-once", "objects/door.py", "        write_edges(w, o, True)\n        grid_remove(w, o)\n", "        write_edges(w, o, True)\n"),
    Change("thwump-lethal-face", "objects/thwump.py", "        elif o.face_y > 0.0:", "        elif o.face_y > 0.0 and o.sign > 0.0 and o.routine:"),
    Change("thwump-snap", "objects/thwump.py", "if dx * dx + dy * dy < o.speed * o.speed:", "if dx * dx + dy * dy <= 1.0:"),
    Change("guard-strict-row", "objects/floor_guard.py", "column != COLUMN[o.cell]", "column >= 0"),
    Change("rocket-edge", "objects/launcher.py", "edge_between(w, old, o.cell) == SOLID", "edge_between(w, old, o.cell) > SOLID"),
    Change("turret-aim-tick", "rules.py", "NEAR_STEP, NEAR_CYCLE = 2.0, 4", "NEAR_STEP, NEAR_CYCLE = 2.0, 3"),
    Change("turret-old-factor", "objects/turret.py", "2.0 * n.x - n.prev_x", "n.x"),
    Change("drone-list-order", "objects/drone.py", "ROTATIONS = [1, 0, 3, 2,", "ROTATIONS = [1, 3, 0, 2,"),
    Change("drone-random-clock", "objects/drone.py", "            o.clock = 0 if odd else 1", "            o.clock = 0"),
    Change("drone-no-u-turn", "objects/drone.py", "    if o.direction == direction ^ 2:\n        return False\n", ""),
    Change("drone-grab", "objects/drone.py", "        o.grab = (direction + 3) % 4 + 1", "        o.grab = (direction + 1) % 4 + 1"),
    Change("chaingun-length", "rules.py", "BURST_SHOTS, BURST_SHOTS_CYCLE = 4, 5", "BURST_SHOTS, BURST_SHOTS_CYCLE = 4, 4"),
    Change("chaingun-side", "objects/drone_weapons.py", "(n.y - n.prev_y) * o.aim_x < 0.0:", "(n.y - n.prev_y) * o.aim_x > 0.0:"),
    Change("laser-end", "objects/drone_weapons.py", "    elif t < 1.0:", "    elif t < 2.0:"),
)  # fmt: skip
"""Each rule that the tests must hold."""
