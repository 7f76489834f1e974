"""A LibreOffice that stays open for all workbooks of a process: to start one takes longer than most of them.

A macro in a profile of its own watches a folder for jobs, each a file with three lines: where a workbook is, where it
goes as LibreOffice has computed it, and whether its values are wanted alone, as texts of 17 digits a sheet: a workbook
takes as long to be written as to be computed. A job is done once its file is gone; one that failed has another name
then.
"""

from __future__ import annotations

import os
import signal
import subprocess
import time
from collections.abc import Sequence
from html import escape
from pathlib import Path

from written_cells import Values

_DOCTYPE = '<!DOCTYPE {0} PUBLIC "-//OpenOffice.org//DTD OfficeDocument 1.0//EN" "{1}.dtd">'
_LIBRARY = 'xmlns:library="http://openoffice.org/2000/library"'
# It ends by itself ten minutes after the last job, should the process end that has started it and not it.
_MACRO = """Sub Watch(folder As String)
  Dim hidden(0) As New com.sun.star.beans.PropertyValue, kept(1) As New com.sun.star.beans.PropertyValue
  Dim book As Object, job As String, source As String, target As String, kind As String, idle As Long
  Dim i As Long, digits As Long, nowhere As New com.sun.star.lang.Locale
  hidden(0).Name = "Hidden" : hidden(0).Value = True
  kept(0).Name = "FilterName" : kept(1).Name = "FilterOptions"
  Do While idle < 30000
    job = Dir(folder & "/*.job")
    If job = "" Then
      Wait 20
      idle = idle + 1
    Else
      idle = 0
      On Error GoTo Failed
      Open folder & "/" & job For Input As #1
      Line Input #1, source
      Line Input #1, target
      Line Input #1, kind
      Close #1
      book = StarDesktop.loadComponentFromURL(source, "_blank", 0, hidden())
      If kind = "values" Then
        digits = book.NumberFormats.addNew("0.0000000000000000E+000", nowhere)
        For i = 0 To book.Sheets.Count - 1
          book.Sheets(i).NumberFormat = digits
        Next
        kept(0).Value = "Text - txt - csv (StarCalc)" : kept(1).Value = "44,34,76,1,,0,true,false,true,false,false,-1"
      Else
        kept(0).Value = "Calc MS Excel 2007 XML" : kept(1).Value = ""
      End If
      book.storeToURL(target, kept())
      book.close(True)
      Kill folder & "/" & job
    End If
Later:
  Loop
  StarDesktop.terminate()
  Exit Sub
Failed:
  Name folder & "/" & job As folder & "/" & job & ".failed"
  Resume Later
End Sub"""
_FILES = {
    # What is stored in cells is computed anew, whatever wrote it; and a new profile would be filled first, over these.
    "registrymodifications.xcu": """<oor:items xmlns:oor="http://openoffice.org/2001/registry">
<item oor:path="/org.openoffice.Office.Calc/Formula/Load"><prop oor:name="OOXMLRecalcMode" oor:op="fuse">
<value>0</value></prop></item>
<item oor:path="/org.openoffice.Setup/Office"><prop oor:name="ooSetupInstCompleted" oor:op="fuse">
<value>true</value></prop></item></oor:items>""",
    "basic/script.xlc": _DOCTYPE.format("library:libraries", "libraries")
    + f"""<library:libraries {_LIBRARY} xmlns:xlink="http://www.w3.org/1999/xlink">
<library:library library:name="Standard" xlink:href="$(USER)/basic/Standard/script.xlb/" xlink:type="simple"
library:link="false"/></library:libraries>""",
    "basic/Standard/script.xlb": _DOCTYPE.format("library:library", "library")
    + f"""<library:library {_LIBRARY} library:name="Standard" library:readonly="false"
library:passwordprotected="false"><library:element library:name="Jobs"/></library:library>""",
    "basic/Standard/Jobs.xba": _DOCTYPE.format("script:module", "module")
    + f"""<script:module xmlns:script="http://openoffice.org/2000/script" script:name="Jobs"
script:language="StarBasic">{escape(_MACRO)}</script:module>""",
}


class Office:
    """LibreOffice on a profile of its own in a folder."""

    def __init__(self, soffice: str, folder: Path, within: float) -> None:
        self.folder, self.within = folder, within
        for name, text in _FILES.items():
            path = folder / "profile" / "user" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(f'<?xml version="1.0" encoding="UTF-8"?>\n{text}', encoding="utf-8")
        profile = f"-env:UserInstallation={(folder / 'profile').as_uri()}"
        self.command = [soffice, profile, "--headless", "--norestore", f'macro:///Standard.Jobs.Watch("{folder}")']
        self.process: subprocess.Popen[bytes] | None = None

    def computed(self, paths: Sequence[Path], out: Path) -> list[Path]:
        """Workbooks as LibreOffice saves them in a folder."""
        for path in paths:
            (out / path.name).unlink(missing_ok=True)
            self._do(path, out / path.name, "workbook")
            assert (out / path.name).exists(), f"LibreOffice cannot compute {path.name}"
        return [out / path.name for path in paths]

    def values(self, path: Path, out: Path) -> Values:
        """What LibreOffice computes of a workbook."""
        self._do(path, out / f"{path.stem}.csv", "values")
        return Values.of_texts(path, lambda title: out / f"{path.stem}-{title}.csv")

    def _do(self, path: Path, to: Path, kind: str) -> None:
        self._start()
        written, job = self.folder / "next", self.folder / "workbook.job"
        written.write_text(f"{path.as_uri()}\n{to.as_uri()}\n{kind}\n", encoding="utf-8")
        written.rename(job)
        deadline = time.monotonic() + self.within
        while job.exists():
            assert self.process and self.process.poll() is None, "LibreOffice has ended"
            assert time.monotonic() < deadline, f"LibreOffice does not answer about {path.name}"
            time.sleep(0.02)

    def _start(self) -> None:
        if self.process is None or self.process.poll() is not None:
            null = subprocess.DEVNULL
            self.process = subprocess.Popen(self.command, stdout=null, stderr=null, start_new_session=True)

    def close(self) -> None:
        if self.process and self.process.poll() is None:
            os.killpg(self.process.pid, signal.SIGTERM)
            self.process.wait(timeout=self.within)
