"""A bookcase against the back wall with books upright, leaning, lying and shown from the front, and things between."""

from books import Books, size
from build import finish, grain, turn
from room import BACK
from shapes import block, lathe

LEFT, RIGHT, HEIGHT, DEPTH = 0.98, 2.14, 2.0, 0.3
BOARD = 0.026
LEVELS = [0.1, 0.5, 0.9, 1.27, 1.63]


def case(scene):
    z = BACK + 0.012 + DEPTH / 2
    wood = lambda name, centre, dims, axis, bevel=0.003: scene.put("bookcase", finish("oak", block(centre, dims), bevel=bevel, uv=grain(name, axis, 0.8)))
    for name, x in (("left", LEFT + BOARD / 2), ("right", RIGHT - BOARD / 2)):
        wood(name, (x, HEIGHT / 2, z), (BOARD, HEIGHT, DEPTH), 1)
    middle, width = (LEFT + RIGHT) / 2, RIGHT - LEFT
    for k, y in enumerate(LEVELS):
        wood("board%d" % k, (middle, y - BOARD / 2, z - 0.004), (width - 2 * BOARD + 0.004, BOARD, DEPTH - 0.012), 0)
    wood("top", (middle, HEIGHT + 0.006, z + 0.008), (width + 0.05, 0.03, DEPTH + 0.03), 0, 0.007)
    wood("plinth", (middle, 0.04, z + DEPTH / 2 - 0.02), (width - 2 * BOARD + 0.004, 0.08, 0.02), 0)
    wood("back", (middle, HEIGHT / 2, BACK + 0.014), (width - 0.02, HEIGHT - 0.02, 0.012), 1)


def vase(profile, material):
    """Thin walls: the inside follows the outside at 3 mm."""
    inside = [(max(r - 0.004, 0), y + (0.004 if y < 0.01 else 0)) for r, y in profile[::-1] if y > 0.008]
    rim = profile[-1]
    return finish(material, lathe(profile + [(rim[0] - 0.002, rim[1] + 0.0015)] + inside + [(0, 0.012)]), smooth=60)


URN = [(0, 0), (0.04, 0), (0.042, 0.006), (0.036, 0.012), (0.05, 0.04), (0.075, 0.09), (0.08, 0.13), (0.066, 0.175), (0.04, 0.2), (0.034, 0.215), (0.045, 0.235)]
POT = [(0, 0), (0.05, 0), (0.054, 0.004), (0.062, 0.03), (0.07, 0.08), (0.073, 0.11)]
JAR = [(0, 0), (0.045, 0), (0.05, 0.005), (0.056, 0.05), (0.054, 0.1), (0.044, 0.125), (0.046, 0.14)]


def build(scene):
    case(scene)
    books = Books(scene)
    x0, z = LEFT + BOARD + 0.006, BACK + DEPTH - 0.02
    y = [level + 0.0008 for level in LEVELS]
    # The lowest board: large ones; a pile at the right.
    end = books.row([9, 17, 4, 8, 13, 2, 7, 3, 16, 0, 10], x0, y[0], z, 1)
    books.row([19], end, y[0], z, 2, lean=11)
    books.row([1, 8, 12, 15], end + 0.13, y[0], z, 22)
    books.pile([17, 9, 13, 4], RIGHT - 0.29, y[0], z - 0.225, 3)
    # The second: leaning after a row, one shown from its front.
    end = books.row([0, 7, 3, 14, 5, 16, 10, 12, 19, 1, 17, 18], x0, y[1], z, 4)
    books.row([6], end, y[1], z, 5, lean=14)
    books.row([8, 11, 4, 15, 2, 9], end + 0.16, y[1], z, 23)
    show(books, 12, RIGHT - 0.13, y[1], z - 0.01)
    # The third: a vase at the left, books at the right.
    scene.put("shelf_things", vase(URN, "glaze_white"), turn(at=(x0 + 0.1, y[2], z - 0.11)))
    end = books.row([1, 18, 11, 15, 12, 6, 3, 8, 14, 2, 5], x0 + 0.22, y[2], z, 7)
    books.row([0], end, y[2], z, 8, lean=12)
    books.row([17, 19, 4], end + 0.12, y[2], z, 24)
    books.pile([2, 10, 7], RIGHT - 0.19, y[2], z - 0.2, 9)
    # The fourth: a pile with a jar on it, and a row.
    top = books.pile([8, 16, 19], x0 + 0.13, y[3], z - 0.2, 10)
    scene.put("shelf_things", vase(JAR, "glaze_blue"), turn(at=(x0 + 0.14, top, z - 0.12)))
    end = books.row([5, 14, 1, 7, 11, 18, 0, 13, 16, 10, 15, 3], x0 + 0.32, y[3], z, 11)
    books.row([15], end, y[3], z, 12, lean=13)
    books.row([17, 9, 4, 2, 6], RIGHT - BOARD - 0.19, y[3], z, 25)
    # The fifth: one from its front, a row, a jar.
    show(books, 4, x0 + 0.12, y[4], z - 0.01)
    end = books.row([16, 3, 0, 10, 13, 6, 19, 12, 1], x0 + 0.27, y[4], z, 13)
    books.row([5], end, y[4], z, 14, lean=10)
    show(books, 14, RIGHT - 0.34, y[4], z - 0.01)
    scene.put("shelf_things", vase(JAR, "terracotta"), turn(at=(RIGHT - 0.12, y[4], z - 0.12)))


def show(books, index, x, y, z):
    """From its front, leaning back a little."""
    w, h, t = size(index)
    lean = 12
    books.put(index, turn(x=-lean, at=(x, y + 0.001, z - 0.02)) @ turn(y=-90, at=(-w / 2, 0, -t / 2)))
