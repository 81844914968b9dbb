<?xml version="1.0" encoding="utf-8"?>
<Program SubType="IEC" xmlns="http://br-automation.co.at/AS/Program">
  <Files>
    <File>Main.st</File>
    <File Private="true">Vars.var</File>
  </Files>
</Program>
