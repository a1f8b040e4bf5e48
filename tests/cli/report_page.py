"""The report of a run, whether the program writes the page of the viewer or, built without it, a static one."""
import json
import re


def page_of(path):
    """The object that the viewer shows; None for a static report."""
    found = re.search(r'<script type="application/json" id="floatframe-page">(.*?)</script>', path.read_text("utf-8"), re.S)
    return json.loads(found[1]) if found else None


def text_of(path):
    """What a reader is told."""
    page = page_of(path)
    return path.read_text("utf-8") if page is None else json.dumps(page, ensure_ascii=False)


def without_clock(path):
    """All but what was measured with a clock."""
    text, page = path.read_text("utf-8"), page_of(path)
    if page is None:
        return re.sub(r'<div class="headline">.*?</div>\n</div>', "", text, flags=re.S)
    del page["speed"]
    page["status"]["sentences"] = [s for s in page["status"]["sentences"] if "processor time" not in s]
    return page, re.search(r'id="floatframe-buffer">(.*?)</script>', text, re.S)[1]
