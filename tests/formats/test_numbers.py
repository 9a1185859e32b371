"""Flash's number rule, game.md §5.2 and §5.3."""

import math
import random
import struct
from collections.abc import Iterator
from decimal import Decimal

import pytest
from hypothesis import example, given, strategies as st

from ninja_game.formats import numbers
from ninja_game.formats.numbers import format_exact, format_number, parse_flash_number
from tests.support.strategies import decimal_texts


@pytest.mark.parametrize(
    "text, value",
    [
        ("0.707106781186547", 0.7071067811865468),
        ("-0.707106781186547", -0.7071067811865468),
        ("408.15", 408.15000000000003),
        ("586.632097968693", 586.6320979686931),
        ("324", 324.0),
        ("-1", -1.0),
        ("24.5", 24.5),
        ("5.", 5.0),
        (".5", 0.5),
        ("-.5", -0.5),
        ("+469", 469.0),
        (" 685", 685.0),
        (" \t\r\n 7", 7.0),
        ("1e2", 100.0),
        ("2.5e2", 250.0),
        ("25E-1", 2.5),
        ("1e+3", 1000.0),
        ("0", 0.0),
        ("08", 8.0),
        ("0.5", 0.5),
    ],
)
def test_decimals_are_summed_digit_by_digit(text: str, value: float) -> None:
    assert parse_flash_number(text) == value


@pytest.mark.parametrize(
    "text, value",
    [
        ("0x64", 100.0),
        ("0X1f", 31.0),
        ("0xFFFFFFFF", -1.0),
        ("0x100000005", 5.0),
        ("0x80000000", -2147483648.0),
        ("0150", 104.0),
        ("070", 56.0),
        ("-070", -56.0),
        ("037777777777", -1.0),
        ("0777777777777777", -1.0),
    ],
)
def test_hexadecimal_and_octal_are_wrapping_32_bit_integers(text: str, value: float) -> None:
    assert parse_flash_number(text) == value


@pytest.mark.parametrize(
    "text",
    ["", " ", "NaN", "nan", "Infinity", "-Infinity", "inf", "abc", ".", "-", "+", "--5", "+-5", "- 5", "685 ", "685a",
     "12\n", "1.2.3", "1,5", "e5", "1e", "1e+", "-0x10", "+0x10", "0x", "0xg", "0x-1", "1_000", "١٢", "\xa05"],
)  # fmt: skip
def test_everything_else_is_nan(text: str) -> None:
    assert math.isnan(parse_flash_number(text))


def test_nan_is_one_object_so_that_equal_texts_give_equal_tuples() -> None:
    assert (parse_flash_number("x"),) == (parse_flash_number("0e999"),)


@pytest.mark.parametrize(
    "text, value",
    [
        ("1e999", math.inf),
        ("-1e999", -math.inf),
        ("1e-999", 0.0),
        ("1e" + "9" * 5000, math.inf),
        ("1e-" + "9" * 5000, 0.0),
        ("1e" + "0" * 5000 + "2", 100.0),
        ("9" * 100_000, math.inf),
        ("0." + "9" * 100_000, parse_flash_number("0." + "9" * 400)),
    ],
)
def test_numbers_beyond_all_bounds_neither_raise_nor_hang(text: str, value: float) -> None:
    assert parse_flash_number(text) == value


def test_a_zero_has_no_sign() -> None:
    assert all(math.copysign(1, parse_flash_number(text)) == 1 for text in ("-0", "-0.0", "-00", "-1e-999"))


def _by_the_page(text: str) -> float:
    """The rule of game.md §5.2 word for word, for unsigned decimals."""
    whole, _, fraction = text.partition(".")
    power, total = len(whole) - 1, 0.0
    for digit in whole + fraction:
        z, b, k = float(digit), 10.0, abs(power)
        while k > 0:
            if k % 2:
                z = z * b if power >= 0 else z / b
            k, b = k // 2, b * b
        total, power = total + z, power - 1
    return total


@given(st.from_regex(r"(0|[1-9][0-9]{0,17})(\.[0-9]{0,20})?", fullmatch=True))
def test_any_decimal_is_what_the_page_says(text: str) -> None:
    assert parse_flash_number(text) == _by_the_page(text)


@pytest.mark.parametrize(
    "value, text",
    [
        (0.7071067811865468, "0.707106781186547"),
        (408.15000000000003, "408.15"),
        (586.6320979686931, "586.632097968693"),
        (0.1 + 0.2, "0.3"),
        (2 / 3, "0.666666666666667"),
        (24.0, "24"),
        (-0.0, "0"),
        (-1.0, "-1"),
        (0.00001, "0.00001"),
        (1e15, "1000000000000000"),
        (123456789012345680.0, "123456789012346000"),
        (1.5e-9, "1.5e-9"),
        (1e300, "1e300"),
        (math.nan, "NaN"),
        (math.inf, "1e999"),
    ],
)
def test_numbers_are_written_with_at_most_15_digits(value: float, text: str) -> None:
    assert format_number(value) == text


@given(decimal_texts)
def test_what_was_read_is_written_so_that_it_reads_the_same(text: str) -> None:
    value = parse_flash_number(text)
    assert parse_flash_number(format_number(value)) == value


def test_numbers_of_15_digits_that_rounding_alone_would_miss() -> None:
    # One decimal in some thousands reads as a value that, rounded to 15 digits, gives another decimal.
    rng = random.Random(1)
    missed = 0
    for _ in range(20_000):
        value = parse_flash_number(f"{rng.randrange(9 * 10**14, 10**15)}e-14")
        missed += parse_flash_number(f"{value:.15g}") != value
        assert parse_flash_number(format_number(value)) == value
    assert missed


def readings_around(value: float) -> Iterator[float]:
    """What the decimals next to a value read as, many more of them than the roundings of a digit sum could miss."""
    unit = Decimal(1).scaleb(Decimal(value).adjusted() - 17)
    return (
        parse_flash_number(f"{Decimal(value) + steps * unit:.{18 - unit.adjusted()}f}") for steps in range(-300, 301)
    )


@given(st.floats(0.001, 1e6))
@example(1.15)
def test_exact_texts_read_as_the_same_value_where_any_text_does(value: float) -> None:
    assert parse_flash_number(format_exact(value)) == value or value not in readings_around(value)


@pytest.mark.parametrize("exponent", [-300, -5, 2, 300])
def test_writing_exactly_looks_at_few_sums(exponent: int, monkeypatch: pytest.MonkeyPatch) -> None:
    rng = random.Random(exponent)
    lengths = []

    def counted(sums: dict[float, str], size: float, power: int, roundings: float) -> dict[float, str]:
        lengths.append(len(sums))
        return longer_sums(sums, size, power, roundings)

    longer_sums = numbers._longer_sums
    monkeypatch.setattr(numbers, "_longer_sums", counted)
    for _ in range(1000):
        value = parse_flash_number(f"{rng.randrange(1, 10)}.{rng.randrange(10**24):024}e{exponent}")
        assert parse_flash_number(format_exact(value)) == value
    assert sum(lengths) < 10_000
    assert max(lengths) < 20


@pytest.mark.parametrize(
    "value", [5e-324, 2.2250738585072014e-308, 1e308, 1.7976931348623157e308, 1 + 2**-52, 10 - 2**-50]
)
def test_numbers_at_the_edges_of_floats_have_texts(value: float) -> None:
    assert parse_flash_number(format_exact(value)) == value or value not in readings_around(value)


@pytest.mark.parametrize("value", [1.13, 1.15])
def test_a_value_that_no_text_reads_as_gets_its_nearest_neighbour(value: float) -> None:
    assert value not in readings_around(value)
    assert abs(parse_flash_number(format_exact(value)) - value) <= math.ulp(value)


def test_few_coordinates_have_no_exact_text() -> None:
    hundredths = [number / 100 for number in range(100, 80_000, 9)]
    assert sum(parse_flash_number(format_exact(value)) != value for value in hundredths) <= 2


@given(st.binary(min_size=8, max_size=8))
def test_any_float_has_a_text_close_to_it(bits: bytes) -> None:
    (value,) = struct.unpack("<d", bits)
    found = parse_flash_number(format_exact(value))
    assert math.isclose(found, value, rel_tol=1e-14, abs_tol=1e-300) or (math.isnan(found) and math.isnan(value))
