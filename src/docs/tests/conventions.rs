//! One comment for each convention, and what it is read as.

use super::sample::{Sample, show};

fn shown(comment: &str) -> String {
    let docs = Sample::above(comment).read();
    show(&docs.items[0])
}

#[test]
fn plain_prose_is_markdown() {
    let text = "(*
    Keeps the level of a tank between two marks.

    The pump starts below `nLow` and stops above nHigh:

    \t- [x] dry run protection
    \t- [ ] soft start

    | state | lamp |
    |-------|------|
    | run   | on   |

    See https://example.org/pump_1, and a*b*c <b>is</b> no emphasis.
*)";
    insta::assert_snapshot!(shown(text), @r"
    brief: Keeps the level of a tank between two marks.
      p The pump starts below `nLow` and stops above nHigh:
      list None
      - Some(true)
        p dry run protection
      - Some(false)
        p soft start
      | state | lamp
      | run | on
      p See [https://example.org/pump_1](https://example.org/pump_1), and a*b*c <b>is</b> no emphasis.
    = Above Taken(Markdown)
    ");
}

#[test]
fn a_box_is_no_text() {
    let text = "(*************************
 * Pump control          *
 *-----------------------*
 * Starts and stops.     *
 *************************)";
    insta::assert_snapshot!(shown(text), @r"
    brief: Pump control
      p Starts and stops.
    = Above Taken(Markdown)
    ");
}

#[test]
fn javadoc_tags() {
    let text = "/**
 * Starts the pump.
 * It runs until {@link FB_Pump} stops.
 *
 * @param[in] bStart rising edge
 *   starts
 * @param nLevel - the level
 * @returns TRUE if it runs
 *
 * Prose goes on.
 * @deprecated use FB_Other
 * @since 1.2
 * @see FB_Pump, FB_Missing
 * @req R-12, R-13
 * @note It is slow.
 * @todo more
 * @internal
 * @example
 *   fb(bStart := TRUE);
 *   x := fb.nLevel;
 */";
    insta::assert_snapshot!(shown(text), @r#"
    brief: Starts the pump.
      p It runs until [`FB_Pump`](item 0) stops.
      p Prose goes on.
      note note Note
        p It is slow.
    param bStart [in] None
      p rising edge starts
    param nLevel [] None
      p the level
    returns
      p TRUE if it runs
    since
      p 1.2
    deprecated
      p use FB_Other
    see
      p [FB_Pump](item 0)
    see
      p [FB_Missing](broken FB_Missing)
    example
      code st "  fb(bStart := TRUE);\n  x := fb.nLevel;"
    todo
      p more
    internal
    req R-12
    req R-13
    = Above Taken(Javadoc)
    "#);
}

#[test]
fn backslash_tags_and_words_that_are_none() {
    let text = "/// \\brief A pump.\n/// \\return nothing; \\frac is no tag\n/// mail me@example.org";
    insta::assert_snapshot!(shown(text), @r"
    brief: A pump.
    returns
      p nothing; \frac is no tag mail me@example.org
    = Above Taken(Javadoc)
    ");
}

#[test]
fn elements() {
    let text = "(*~
\t<docu>
\t\t<summary>
\t\t\tStarts the <c>pump</c>.
\t\t\t<para>See <see cref=\"PlcDocu.Basics.FB_Pump.Stop()\"/>.</para>
\t\t</summary>
\t\t<param name=\"bStart\">edge &lt; 1</param>
\t\t<returns>TRUE</returns>
\t\t<remarks>
\t\t\tLong.
\t\t\t<note type=\"warning\">No safety function!</note>
\t\t\tLonger.
\t\t</remarks>
\t\t<example>
\t\t\t<code>
\t\t\t\tfb(bStart := TRUE);
\t\t\t\t  IF a < b THEN
\t\t\t</code>
\t\t</example>
\t</docu>
~*)";
    insta::assert_snapshot!(shown(text), @r#"
    brief: Starts the `pump`.
      p See [`FB_Pump.Stop`](broken PlcDocu.Basics.FB_Pump.Stop()).
      p Long.
      note warning Warning
        p No safety function!
      p Longer.
    param bStart [] None
      p edge < 1
    returns
      p TRUE
    example
      code st "fb(bStart := TRUE);\n  IF a < b THEN"
    = Above Taken(Xml)
    "#);
}

#[test]
fn elements_that_do_not_nest_are_text() {
    insta::assert_snapshot!(shown("/// <summary>Starts <c>the</summary> pump."), @r"
    brief: <summary>Starts <c>the</summary> pump.
    = Above Taken(Xml)
    ");
}

#[test]
fn te1030_forms() {
    let text = "//!<summary>Starts $FB_Pump.</summary>\n//!@param bStart the edge\n(*!<description>All of it.\n<ul><li>one</li><li>two</li></ul>\n<table><tr><th>a</th><th>b</th></tr><tr><td>1</td><td>2</td></tr></table>\n<code> i := i + 1; </code></description>*)";
    insta::assert_snapshot!(shown(text), @r#"
    brief: Starts [`FB_Pump`](item 0).
      p All of it.
      list None
      - None
        p one
      - None
        p two
      | a | b
      | 1 | 2
      code st "i := i + 1; "
    param bStart [] None
      p the edge
    = Above Taken(Te1030)
    = Above Taken(Te1030)
    "#);
}

#[test]
fn libdoc() {
    let text = "(*
Pump
====

Starts with ``bStart``, see :fb:`FB_Pump` and `the page <https://example.org>`_.

:return: TRUE
    if it runs

.. note:: It is slow.
   Really.

.. code-block:: st

   fb();
     x := 1;

.. an internal remark

End::

    literal
*)";
    insta::assert_snapshot!(shown(text), @r#"
    brief: Pump
      p Starts with `bStart`, see [`FB_Pump`](item 0) and [the page](https://example.org).
      note note Note
        p It is slow. Really.
      code st "fb();\n  x := 1;"
      p End:
      code  "literal"
    returns
      p TRUE if it runs
    = Above Taken(LibDoc)
    "#);
}

#[test]
fn plcdoc() {
    let text = "(*
A pump.

:var_in BOOL bStart: The edge
:var_out nLevel: The level
:rtype: INT
*)";
    insta::assert_snapshot!(shown(text), @r"
    brief: A pump.
    param bStart [in] None
      p The edge
    param nLevel [out] None
      p The level
    fact rtype: INT
    = Above Taken(Plcdoc)
    ");
}

#[test]
fn oscat() {
    let text = "(*
version 1.3\t2. jan. 2009
programmer \tanna
tested by\tben

this block starts a pump.
it also stops it

revision history
an 2. jan. 2009 rev 1.3
\tfirst
*)";
    insta::assert_snapshot!(shown(text), @r#"
    brief: this block starts a pump. it also stops it
    version
      p 1.3	2. jan. 2009
    author
      p anna
    fact tested by: ben
    history
      code text "an 2. jan. 2009 rev 1.3\n\tfirst"
    = Above Taken(Oscat)
    "#);
}

#[test]
fn a_header_with_a_description() {
    let text = "//**********************
// Copyright: A. Company
// Author: Anna
// Created: May 2, 2022
// Description: Tasks of the
//              pump.
//**********************";
    insta::assert_snapshot!(shown(text), @r"
    brief: Tasks of the pump.
    = Above Taken(Markdown)
    ");
    let text = "(* Author: Anna\n   Version: 1.2\n   Description: Runs the pump. *)";
    insta::assert_snapshot!(shown(text), @r"
    brief: Runs the pump.
    version
      p 1.2
    author
      p Anna
    = Above Taken(FileHeader)
    ");
}

#[test]
fn a_header_of_the_file_says_nothing() {
    let text = "(***********
 * COPYRIGHT -- A Company
 ***********
 * Library: Pumps
 * File: Pumps.fun
 ***********
 * Functions and function blocks of library Pumps
 ***********)";
    insta::assert_snapshot!(shown(text), @r"
    = Above Rejected(Licence)
    ");
}

#[test]
fn a_description_in_a_pragma() {
    let mut sample = Sample::new();
    let pragma = sample.pragma("{description := \"the [FB_Pump] runs\";}");
    let id = sample.item(crate::library::ItemKind::FunctionBlock, "FB_Pump", None, Vec::new());
    sample.edit(id).pragmas.push(pragma);
    insta::assert_snapshot!(show(&sample.read().items[0]), @r"
    brief: the [FB_Pump](item 0) runs
    ");
}

#[test]
fn line_breaks_that_wrapping_does_not_explain_stay() {
    let text = "// Brief\n//\n// The states are given by a number in the following way, which is wrapped\n// by hand here:\n// 0 = off\n// 1 = on";
    insta::assert_snapshot!(shown(text), @r"
    brief: Brief
      p The states are given by a number in the following way, which is wrapped by hand here:⏎0 = off⏎1 = on
    = Above Taken(Markdown)
    ");
}

#[test]
fn alerts_are_notes() {
    insta::assert_snapshot!(shown("/// A pump.\n///\n/// > [!IMPORTANT]\n/// > It is slow."), @r"
    brief: A pump.
      note warning Important
        p It is slow.
    = Above Taken(Markdown)
    ");
}
