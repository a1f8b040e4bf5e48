#!/usr/bin/env python3
"""floatframe compare: exit codes, what is printed, the page."""
import html.parser
import json
import os
import unittest

from report_page import page_of
from run_case import RunCase


class Compare(RunCase):
    def run_model(self, out, *arguments):
        self.program("run", "m.yaml", "--duration", "0.2", "--out", out, "--no-report", *arguments)

    def setUp(self):
        super().setUp()
        self.run_model("one")
        self.run_model("two", "--coordinates", "absolute")

    def test_a_run_equals_itself(self):
        self.run_model("again")
        done = self.program("compare", "one", "again", "--tolerance", "0")
        self.assertIn("equal to the last bit", done.stdout)

    def test_tolerances_decide(self):
        self.assertIn("largest difference", self.program("compare", "one", "two").stdout)
        within = self.program("compare", "one", "two/results.csv", "--tolerance", "0.05", "--absolute", "1e-3")
        self.assertIn("within 0.05 of the size and 0.001", within.stdout)
        beyond = self.program("compare", "one", "two", "--tolerance", "1e-15", code=1)
        self.assertIn("beyond the tolerance: ", beyond.stderr)
        data = json.loads(self.program("compare", "one", "two", "--tolerance", "1e-15", "--json", code=1).stdout)
        self.assertFalse(data["agrees"])
        self.assertEqual(data["instants"], 201)
        self.assertFalse(data["interpolated"])
        tip = {c["name"]: c for c in data["channels"]}["tip.z"]
        self.assertGreater(tip["largest"], 0.0)
        self.assertGreaterEqual(tip["largest"], tip["rms"])

    def test_another_span_is_a_difference(self):
        self.program("run", "m.yaml", "--duration", "0.1", "--out", "short", "--no-report")
        done = self.program("compare", "one", "short", "--tolerance", "0", code=1)
        self.assertIn("covers 0 to 0.2 s", done.stderr)
        self.program("compare", "one", "short", "--tolerance", "0", "--overlap")

    def test_the_page(self):
        self.program("compare", "one", "two", "--report", "page.html")
        page = (self.folder / "page.html").read_text()
        names = [c.split(" [")[0] for c in (self.folder / "one" / "results.csv").read_text().split("\n")[0].split(",")[1:]]
        data = page_of(self.folder / "page.html")
        if data is not None:
            self.assertEqual((data["kind"], data["status"]["state"]), ("compare", "compared"))
            self.assertEqual(data["facts"][0]["rows"][:2], [["A", "one/results.csv"], ["B", "two/results.csv"]])
            channels = data["curves"]["channels"]
            self.assertEqual(sorted(c["name"] for c in channels), sorted(names))
            self.assertEqual(data["curves"]["names"], ["A: one/results.csv", "B: two/results.csv"])
            table = {c["name"]: c for c in json.loads(self.program("compare", "one", "two", "--json").stdout)["channels"]}
            drawn = [c for c in channels if c.get("other")]
            self.assertTrue(drawn)
            for channel in drawn:
                self.assertEqual(channel["difference"]["max"], table[channel["name"]]["largest"])
                self.assertEqual(channel["difference"]["rms"], table[channel["name"]]["rms"])
            self.program("compare", "one", "two", "--tolerance", "1e-15", "--report", "page.html", code=1)
            data = page_of(self.folder / "page.html")
            self.assertEqual(data["status"]["state"], "differ")
            self.assertTrue(data["curves"]["channels"][0]["difference"]["beyond"])
            self.program("compare", "one", "one", "--tolerance", "0", "--report", "page.html")
            self.assertEqual(page_of(self.folder / "page.html")["status"]["state"], "agree")
            return
        header = (self.folder / "one" / "results.csv").read_text().split("\n")[0]
        html.parser.HTMLParser().feed(page)
        self.assertEqual(page.count("<figure>"), len(header.split(",")) - 1)
        self.assertNotIn("<script", page)
        self.assertIn("one/results.csv", page)

    def test_runs_without_a_common_channel(self):
        (self.folder / "other.csv").write_text("time [s],mine [m]\n0,1\n0.1,2\n")
        (self.folder / "bare.csv").write_text("time [s]\n0\n0.1\n")
        for other in ("other.csv", "bare.csv"):
            for arguments in ((), ("--tolerance", "1"), ("--json",), ("--report", "page.html")):
                done = self.program("compare", "one", other, *arguments, code=2)
                self.assertIn(f"{other}:1: found no channel that 'one/results.csv' has too", done.stderr)
                self.assertEqual(done.stdout, "")
        self.assertFalse((self.folder / "page.html").exists())

    def test_bad_input(self):
        self.assertIn("does not exist", self.program("compare", "one", "three", code=2).stderr)
        self.assertIn("there is no channel 'spinn', did you mean 'spin'?",
                      self.program("compare", "one", "two", "--channel", "spinn", code=2).stderr)
        self.assertIn("--tolerance", self.program("compare", "one", "two", "--tolerance", "-1", code=2).stderr)
        refused = self.program("compare", "one", "two", "--report", "one/results.csv", code=2).stderr
        self.assertIn("one/results.csv", refused)
        os.mkfifo(self.folder / "pipe")
        self.assertIn("pipe: ", self.program("compare", "one", "pipe", code=2).stderr)


if __name__ == "__main__":
    unittest.main()
