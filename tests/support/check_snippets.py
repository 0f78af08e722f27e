#!/usr/bin/env python3
"""check_snippets.py PAGE.md: every block after `<!-- from: DECK -->` stands in that deck, record by record."""
import re
import sys

page = open(sys.argv[1], encoding="utf-8").read()
blocks = re.findall(r"<!-- from: (\S+) -->\n```\w*\n(.*?)```", page, re.S)
records = [(deck, record) for deck, text in blocks for record in re.findall(r"^&.*?/\n", text, re.M | re.S)]
wrong = [(deck, record) for deck, record in records if record not in open(deck, encoding="utf-8").read()]
for deck, text in wrong:
    print(f"{sys.argv[1]}: not in {deck}:", text, sep="\n")
print(f"{len(records)} records, {len(wrong)} not in their decks")
sys.exit(1 if wrong or not records else 0)
