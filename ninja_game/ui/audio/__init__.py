"""Sounds and music in play. Their files lie in ``assets``; tools/make_sounds.py makes them."""
