#!/usr/bin/env python3
"""`floatframe sweep --report`: the page of a study, and the pages of its best and its worst run."""
import json
import unittest

from report_page import page_of
from sweep_case import CRANK, Sweep

STUDY = ("--vary", "rate=40:60:3", "--duration", "0.02")


class Pages(Sweep):
    def study(self, *arguments):
        done = self.sweep(0, CRANK, *STUDY, "--out", "out", "--report", "out/study.html", *arguments)
        self.assertIn("out/study.html", done.stdout)
        return page_of(self.folder / "out" / "study.html")["study"]

    def test_best_and_worst_are_those_of_the_table(self):
        study = self.study("--maximize", "slider.x:rms", "--measure", "slider.y:max")
        rows = self.rows("out")
        ranked = sorted(rows, key=lambda row: -float(row["slider.x rms [m]"]))
        self.assertEqual(study["pages"]["best"]["run"] + 1, int(ranked[0]["run"]))
        self.assertEqual(study["pages"]["worst"]["run"] + 1, int(ranked[-1]["run"]))
        for name, row in (("best", ranked[0]), ("worst", ranked[-1])):
            self.assertEqual(study["pages"][name]["address"], f"{name}/report.html")
            page = page_of(self.folder / "out" / name / "report.html")
            self.assertEqual(page["kind"], "run")
            # It is the run of the study, with its values, to the last bit.
            kept = self.folder / "out" / "runs" / row["run"] / "results.csv"
            self.assertEqual((self.folder / "out" / name / "results.csv").read_bytes(), kept.read_bytes())
            settings = json.loads((self.folder / "out" / name / "summary.json").read_text("utf-8"))["settings"]
            self.assertEqual(settings["rate"], row["rate"])

    def test_a_study_that_is_complete_gets_another_page(self):
        self.study("--minimize", "slider.x:max")
        table = self.table("out")
        self.assertIsNone(self.study()["ranking"])
        self.assertEqual(self.table("out"), table)

    def test_what_does_not_fit_is_refused(self):
        for arguments, words in ((("--minimize", "slider.x:max"), "expected --report"),
                                 (("--report", "p.html", "--minimize", "slider.x"), "without a statistic"),
                                 (("--report", "p.html", "--minimize", "slider.x:max", "--maximize", "slider.x:min"), "exclude each other"),
                                 (("--report", "p.html", "--maximize", "slidr.x:max"), "did you mean 'slider.x'")):
            done = self.sweep(2, CRANK, *STUDY, "--out", "out", *arguments)
            self.assertIn(words, done.stderr)
            self.assertFalse((self.folder / "p.html").exists())


if __name__ == "__main__":
    unittest.main()
