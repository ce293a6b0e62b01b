"""Chance that leaves nothing out."""


class Deck:
    """Draws one after another, all of them before any comes again."""

    def __init__(self, rng, cards):
        self.rng, self.cards, self.left = rng, list(cards), []

    def draw(self, can_be=lambda card: True):
        """The next one that can be just now."""
        if not any(can_be(card) for card in self.left):
            self.left = self.rng.sample(self.cards, len(self.cards))
        card = next(card for card in self.left if can_be(card))
        self.left.remove(card)
        return card
