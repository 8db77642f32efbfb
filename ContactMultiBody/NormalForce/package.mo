within ContactMultiBody;
package NormalForce "Laws of the normal force between compliant bodies"
  extends Modelica.Icons.FunctionsPackage;

  annotation (Documentation(info="<html>
<p>
With penetration depth x, approach speed dx/dt, speed v<sub>0</sub> at the start of the contact, stiffness K and exponent n
(1 or 3/2), the normal force is
</p>
<blockquote><pre>
F = K x^n (1 + d(e) (dx/dt)/v0),  never negative, zero at x = 0.
</pre></blockquote>
<p>
The free impact under this law can be integrated in closed form. With r = (dx/dt)/v<sub>0</sub> it ends at r = -e<sub>out</sub> where
</p>
<blockquote><pre>
(1 + d)/(1 - d e_out) = exp(d (1 + e_out)),
</pre></blockquote>
<p>
whatever K, n, the masses and v<sub>0</sub> are. <a href=\"modelica://ContactMultiBody.NormalForce.exact\">exact</a> solves this
equation for d with e<sub>out</sub> = e, so that exactly the restitution asked for is delivered. The other functions give
the damping factors of published laws; this is what those deliver:
</p>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"2\">
<tr><th>law</th><th>d(e)</th><th>e = 0.1</th><th>0.3</th><th>0.5</th><th>0.7</th><th>0.9</th></tr>
<tr><td>exact</td><td>solved</td><td>0.100</td><td>0.300</td><td>0.500</td><td>0.700</td><td>0.900</td></tr>
<tr><td>juhasz</td><td>(1-e)/e</td><td>0.111</td><td>0.370</td><td>0.594</td><td>0.777</td><td>0.931</td></tr>
<tr><td>huntCrossley</td><td>3(1-e)/2</td><td>0.516</td><td>0.581</td><td>0.663</td><td>0.768</td><td>0.909</td></tr>
<tr><td>herbertMcWhannell</td><td>6(1-e)/((2e-1)<sup>2</sup>+3)</td><td>0.491</td><td>0.520</td><td>0.594</td><td>0.723</td><td>0.901</td></tr>
<tr><td>leeWang</td><td>3(1-e)/4</td><td>0.687</td><td>0.739</td><td>0.799</td><td>0.869</td><td>0.952</td></tr>
<tr><td>lankaraniNikravesh</td><td>3(1-e<sup>2</sup>)/4</td><td>0.665</td><td>0.684</td><td>0.725</td><td>0.796</td><td>0.913</td></tr>
<tr><td>gonthier</td><td>(1-e<sup>2</sup>)/e</td><td>0.101</td><td>0.304</td><td>0.488</td><td>0.670</td><td>0.876</td></tr>
<tr><td>flores</td><td>8(1-e)/(5e)</td><td>0.069</td><td>0.256</td><td>0.470</td><td>0.683</td><td>0.894</td></tr>
<tr><td>huGuo</td><td>3(1-e)/(2e)</td><td>0.074</td><td>0.271</td><td>0.488</td><td>0.697</td><td>0.900</td></tr>
</table>
<p>
The table holds for a free impact. Where weight or other forces act during the contact, slow bounces lose more than e says.
</p>
</html>"));
end NormalForce;
