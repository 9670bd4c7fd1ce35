#!/usr/bin/env python3
"""The test of the documents, on documents of its own: it fails where they are wrong, and only there."""
import pathlib
import shutil
import sys
import tempfile
import unittest

import how_to_add
from document import DocumentError, parse
from listed import synopsis_problem
from masks import masked, numbers, shape, stands_in
from paths_test import dead_paths
from rehearsal import Rehearsal


class Mechanism(unittest.TestCase):
    def setUp(self):
        self.root = pathlib.Path(tempfile.mkdtemp(prefix="trivela-mechanism-"))
        self.addCleanup(shutil.rmtree, self.root)
        for made in ("config", "docs/figures", "tests/docs", "tests/vectors", "build"):
            (self.root / made).mkdir(parents=True)
        (self.root / "config/default.toml").write_text("domain_id = 42 # of all\ntag = \"trivela\"\n")
        (self.root / "tests/docs/not_run.txt").write_text("# none\nsleep .*\ttakes long\n")

    def play(self, text, full=False, update=False):
        """(problems, the document as --update leaves it)."""
        with tempfile.TemporaryDirectory() as folder:
            document = parse("x.md", text)
            rehearsal = Rehearsal(self.root, self.root / "build", pathlib.Path(folder).resolve(), full, update)
            return rehearsal.play(document), "\n".join(rehearsal.updated(document))

    def problems(self, text, full=False):
        return self.play(text, full)[0]

    def test_what_is_shown_is_compared(self):
        self.assertEqual(self.problems("Text.\n\n    $ printf 'a\\nb 1\\n'\n    a\n    b 1\n\nMore.\n"), [])
        wrong = self.problems("Text.\n\n    $ printf 'a\\nb 2\\n'\n    a\n    b 1\n\nMore.\n")
        self.assertEqual(len(wrong), 1)
        self.assertIn("x.md:3", wrong[0])
        self.assertIn("-b 1", wrong[0])
        self.assertIn("+b 2", wrong[0])
        self.assertEqual(len(self.problems("    $ echo a\n    a\n    b\n")), 1)
        self.assertEqual(len(self.problems("    $ printf 'a\\nb\\n'\n    a\n")), 1)

    def test_exit_codes_are_compared(self):
        self.assertEqual(self.problems("    $ true\n"), [])
        self.assertIn("exit code 1, 0 is documented", self.problems("    $ false\n")[0])
        self.assertEqual(self.problems('<!-- run: exit="3" -->\n\n    $ exit 3\n'), [])
        self.assertEqual(len(self.problems('<!-- run: exit="3" -->\n\n    $ true\n')), 1)

    def test_programs_of_the_repository_are_commands_without_a_prompt(self):
        self.assertIn("exit code 127", self.problems("    build/release/trivela match\n")[0])
        self.assertEqual(self.problems("    build = release    (a formula)\n"), [])

    def test_only_listed_commands_are_left_out(self):
        self.assertEqual(self.problems("    $ sleep 1e9\n"), [])

    def test_a_file_made_by_one_block_is_used_by_the_next(self):
        self.assertEqual(self.problems("    $ echo 7 > out/x\n\nText.\n\n    $ cat out/x\n    7\n"), [])

    def test_a_reduced_run_and_all_that_rests_on_it_are_compared_by_shape(self):
        text = ('<!-- run: reduced="17 => 3" -->\n\n    $ echo "n 17" | tee f\n    n 17\n\nText.\n\n    $ cat f > g\n'
                "    $ cat g\n    n 17\n")
        self.assertEqual(self.problems(text), [])
        self.assertEqual(self.problems(text, full=True), [])
        self.assertEqual(len(self.problems(text.replace("    n 17", "    m 17"))), 2)
        self.assertEqual(len(self.problems(text.replace("    n 17", "    n 18"), full=True)), 2)
        self.assertIn("no command of the block has 16", self.problems(text.replace("17 =>", "16 =>"))[0])

    def test_parts_of_an_output_and_numbers_of_a_table(self):
        text = ('<!-- run: name="c" from="^b" until="^b" -->\n\n    $ printf "a\\nb 4.50\\nc 1,234\\n"\n    b 4.50\n\n'
                '<!-- output: of="c" from="^c" -->\n\n    c 1,234\n\n<!-- numbers: of="c" -->\n\n| x | 4.50 | 1,234 |\n')
        self.assertEqual(self.problems(text), [])
        self.assertIn("4.51", self.problems(text.replace("| 4.50", "| 4.51"))[0])
        self.assertIn("prints nothing from ^z", self.problems(text.replace('"^c"', '"^z"'))[0])
        self.assertIn("no command named d", self.problems(text.replace('of="c" from', 'of="d" from'))[0])

    def test_figures_are_compared(self):
        (self.root / "docs/figures/f.svg").write_text("<svg/>\n")
        self.assertEqual(self.problems("    $ echo '<svg/>' > docs/figures/f.svg\n"), [])
        self.assertIn("not what the command draws", self.problems("    $ echo '<svg></svg>' > docs/figures/f.svg\n")[0])
        self.assertIn("not a figure", self.problems("    $ echo '<svg>' > docs/figures/f.svg\n")[0])
        named = '<!-- run: figure="g.svg => docs/figures/f.svg" -->\n\n    $ echo "<svg/>" > g.svg\n'
        self.assertEqual(self.problems(named), [])

    def test_update_writes_what_is_printed(self):
        text = "    $ echo 2\n    1\n\n-  x\n\n      $ printf 'a\\n\\nb\\n'\n      a\n\nEnd.\n"
        problems, updated = self.play(text, update=True)
        self.assertEqual(problems, [])
        self.assertEqual(updated, text.replace("    1\n", "    2\n").replace("      a\n", "      a\n\n      b\n"))
        self.assertEqual(self.problems(updated), [])
        speed = "    $ echo 'played 602 s in 18.1 s: 33.3 times real time'\n    played 602 s in 9.0 s: 66.9 times real time\n"
        self.assertEqual(self.play(speed, update=True)[1], speed)

    def test_what_is_written_once_stays(self):
        text = ("<!-- run: name='c' -->\n\n    $ printf 'a\\n  b 1\\n    c\\n'\n\n".replace("'c'", '"c"') +
                '<!-- output: of="c" from="b" until="c" -->\n\n      b 0\n        c\n\nEnd.\n')
        updated = self.play(text, update=True)[1]
        self.assertEqual(updated, text.replace("b 0", "b 1"))
        self.assertEqual(self.play(updated, full=True, update=True), ([], updated))

    def test_programs_at_once_and_programs_that_go_on(self):
        text = ('<!-- run: together="yes" -->\n\n'
                '    $ sh -c "trap \'exit 0\' TERM; touch ready; while :; do :; done"\n'
                '    $ sh -c "until [ -e ready ]; do :; done"\n')
        self.assertEqual(self.problems(text), [])
        self.assertIn("exit code", self.problems(text.replace("exit 0", "exit 4"))[0])
        text = '<!-- run: interrupt="ready" -->\n\n    $ sh -c "trap \'exit 0\' INT; echo ready; while :; do :; done"\n'
        self.assertEqual(self.problems(text), [])

    def test_annotations_are_checked(self):
        for text in ('<!-- run: nmae="x" -->\n\n    $ true\n', '<!-- run: name="x" -->\n\nText.\n',
                     '<!-- run: name="x" -->\n', "<!-- run: name=x -->\n\n    $ true\n",
                     '<!-- numbers: of="x" -->\n\n    $ true\n', '<!-- run: name="x" -->\n\n    formula = 3\n'):
            with self.assertRaises(DocumentError, msg=text):
                parse("x.md", text)

    def test_masks_are_narrow(self):
        self.assertEqual(masked(["Session 3e607494-ce43-4047-a66d-df29a96cfa39: seed 1, version 0.1.0-12-gabc, x"]),
                         ["Session UUID: seed 1, version VERSION, x"])
        for kept in ("31 of 37 kicks", "difference +23.4 points", "seed 1, 60 of 253 kicks"):
            self.assertEqual(masked([kept]), [kept])
        self.assertEqual(shape(["a  1.5 (-2 to +3)  b_2 "]), shape(["a 17 (0.1 to 4) b_2"]))
        self.assertNotEqual(shape(["a 1 b"]), shape(["a b"]))
        self.assertEqual(numbers("-1,234.5 % of v2, 9.6e-6"), ["1234.5", "9.6e-6"])
        self.assertTrue(stands_in("0.52", {"0.5231", "7"}))
        self.assertFalse(stands_in("0.53", {"0.5231", "7"}))
        self.assertTrue(stands_in("9.58e-6", {"9.5791e-06"}))

    def test_verbs_and_flags_of_the_text_must_be_there(self):
        known = {(): "  match   play", ("match",): "  --half TEXT\n  --minutes"}
        self.assertEqual(synopsis_problem(None, "trivela match --half moving", known), "")
        self.assertIn("no --hal", synopsis_problem(None, "trivela match --hal moving", known))
        self.assertIn("no verb mach", synopsis_problem(None, "trivela mach --half moving", known))

    def test_recipes_make_the_edits_that_they_show(self):
        page = ("## A word\n\n```diff\n+++ a.txt\n one\n+and a half\n@@\n-two\n+three\n```\n\n"
                "```diff\n+++ b/new.txt\n+\n+text\n```\n\n    $ cat a.txt\n")
        (self.root / "a.txt").write_text("one\ntwo\n")
        recipes = how_to_add.recipes_of(page)
        self.assertEqual([(recipe.title, recipe.commands) for recipe in recipes], [("A word", ["cat a.txt"])])
        files, problems = how_to_add.apply(recipes, self.root)
        self.assertEqual((files, problems), ({"a.txt": "one\nand a half\nthree\n", "b/new.txt": "\ntext\n"}, []))
        for text, why in (("one\ntwo\none\n", "2 times"), ("one\n", "0 times"), ("one\n two\n", "0 times")):
            (self.root / "a.txt").write_text(text)
            self.assertIn(why, how_to_add.apply(recipes, self.root)[1][0])
        (self.root / "b").mkdir()
        (self.root / "b/new.txt").write_text("there already\n")
        self.assertIn("b/new.txt exists", how_to_add.apply(recipes, self.root)[1][-1])
        with self.assertRaises(ValueError):
            how_to_add.recipes_of("## A word\n\n```diff\n+++ a.txt\none\n```\n")

    def test_paths_that_are_not_there_are_named(self):
        (self.root / "docs/x.md").write_text("there\n")
        text = "`docs/x.md` `docs/NAME.md` `docs/*.md` [x](x.md) `sim/fire` `elsewhere/x`\n`docs/y.md`\n[y](y.md#z)\n```\n[a](b)\n```\n"
        found = list(dead_paths(self.root, "docs/z.md", text, {"docs", "sim"}, {"sim/fire"}))
        self.assertEqual(found, [(2, "docs/y.md"), (3, "y.md")])


if __name__ == "__main__":
    sys.exit(unittest.main())
